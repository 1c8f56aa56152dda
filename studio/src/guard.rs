//! Whose request is answered: `Host`, `Origin`, token, `Sec-Fetch-Site`.
//!
//! A page of another site can have the user's browser send requests here. By its own name, it says so in `Origin` or
//! `Sec-Fetch-Site`. By a name of its own that it lets point to 127.0.0.1 (DNS rebinding), it says so in `Host`. And it
//! does not know the token, which the user's browser alone was given.

use crate::{
    error::ApiError,
    http::{Answer, Head, Status},
    token::Token,
};
use std::net::{Ipv4Addr, Ipv6Addr};

/// Distinguishes this server's requests from foreign ones.
pub(crate) struct Guard {
    token: Token,
}

/// Where a request goes that passed.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Target<'a> {
    /// A path below the page's address, without its query.
    Below(&'a str),
    /// The page's address without the slash, from which its relative addresses would be wrong.
    WithoutSlash,
}

/// Why a request is not answered.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    /// It came by another name or from another page.
    Foreign(ApiError),
    /// It does not know the token, and learns nothing.
    NoToken,
}

impl From<&Refusal> for Answer {
    fn from(refusal: &Refusal) -> Self {
        match refusal {
            Refusal::Foreign(error) => Self::from(error),
            Refusal::NoToken => Self::empty(Status::NotFound),
        }
    }
}

impl Guard {
    /// The guard of a server with this token.
    pub(crate) fn new(token: Token) -> Self {
        Self { token }
    }

    /// The path of the page, with the token.
    pub(crate) fn page(&self) -> String {
        format!("/{}/", self.token.text())
    }

    /// Where the request goes.
    pub(crate) fn pass<'a>(&self, head: &'a Head) -> Result<Target<'a>, Refusal> {
        let host = head.host.as_deref().filter(|host| is_local(host));
        let host = host.ok_or_else(|| foreign("the request names another host"))?;
        let site = head.fetch_site.as_deref();
        // A proxy may put another name of this machine for the page's; that the page is its own, the browser knows.
        let own = |origin: &str| match origin.split_once("://") {
            Some(("http", page)) if page.eq_ignore_ascii_case(host) => true,
            Some(("http" | "https", page)) => site == Some("same-origin") && is_local(page),
            _ => false,
        };
        if !head.origin.as_deref().is_none_or(own) {
            return Err(foreign("the request comes from another page"));
        }
        let path = head.target.split('?').next().unwrap_or_default();
        let path = path.strip_prefix('/').ok_or(Refusal::NoToken)?;
        let (token, below) = match path.split_once('/') {
            Some((token, below)) => (token, Target::Below(below)),
            None => (path, Target::WithoutSlash),
        };
        if !self.token.is(token) {
            return Err(Refusal::NoToken);
        }
        // A link in another page may lead to this one, and to nothing below it.
        let is_page = matches!(below, Target::Below("") | Target::WithoutSlash);
        if !is_page && site.is_some_and(|site| !matches!(site, "same-origin" | "none")) {
            return Err(foreign("another site asked for this"));
        }
        Ok(below)
    }
}

/// Returns true if a host, with or without a port, is this machine without any name lookup. The port may be that of a
/// tunnel or a proxy that forwards the request.
fn is_local(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|b| b.is_ascii_digit()) => name,
        _ => host,
    };
    let name = name.strip_suffix('.').unwrap_or(name);
    let v6 = name.strip_prefix('[').and_then(|v6| v6.strip_suffix(']'));
    match v6 {
        Some(v6) => v6.parse().is_ok_and(|v6: Ipv6Addr| v6.is_loopback()),
        None => {
            let v4 = name.parse::<Ipv4Addr>();
            name.eq_ignore_ascii_case("localhost") || v4.is_ok_and(|v4| v4.is_loopback())
        }
    }
}

fn foreign(error: &str) -> Refusal {
    Refusal::Foreign(ApiError::new(
        Status::Forbidden,
        error,
        "open the address that `asperity studio` printed; behind a tunnel or a proxy, by the name localhost",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guard() -> (Guard, String) {
        let guard = Guard::new(Token::random().unwrap());
        let page = guard.page();
        (guard, page)
    }

    fn head(target: &str, host: Option<&str>, origin: Option<&str>, site: Option<&str>) -> Head {
        Head {
            target: target.to_owned(),
            host: host.map(str::to_owned),
            origin: origin.map(str::to_owned),
            fetch_site: site.map(str::to_owned),
            ..Head::default()
        }
    }

    #[test]
    fn names_of_this_machine_pass_at_any_port_and_all_others_are_foreign() {
        let (guard, page) = guard();
        for host in [
            "127.0.0.1:4000",
            "127.0.0.1:9000",
            "127.0.0.2:80",
            "127.0.0.1",
            "localhost:18080",
            "LocalHost:4000",
            "LOCALHOST",
            "localhost.:4000",
            "localhost.",
            "[::1]:4000",
            "[::1]",
            "[0:0:0:0:0:0:0:1]:9000",
        ] {
            let head = head(&page, Some(host), Some(&format!("http://{host}")), None);
            assert_eq!(guard.pass(&head), Ok(Target::Below("")), "{host}");
        }
        let hosts = [
            "evil.example:4000",
            "localhost.evil.example",
            "localhost.evil.example:4000",
            "evil.localhost:4000",
            "evil-localhost:4000",
            "localhost..:4000",
            "127.0.0.1.evil.example:4000",
            "127.0.0.1:4000.evil.example",
            "127.0.0.1:4000:evil",
            "localhost:4000@evil.example",
            "localhost@evil.example:4000",
            "evil.example@localhost:4000",
            "evil.example:localhost",
            "localhost:4000/",
            "localhost:-1",
            "localhost:+80",
            "localhost 4000",
            "0.0.0.0:4000",
            "10.0.0.1:4000",
            "127.1:4000",
            "0127.0.0.1:4000",
            "2130706433:4000",
            "::1",
            "[::1",
            "[::]:4000",
            "[::2]:4000",
            "[::1]evil.example:4000",
            "[localhost]:4000",
            ":4000",
            ".",
            "",
        ];
        for host in hosts.map(Some).into_iter().chain([None]) {
            let origin = host.map(|host| format!("http://{host}"));
            for origin in [None, origin.as_deref()] {
                let head = head(&page, host, origin, Some("same-origin"));
                let refused = guard.pass(&head).unwrap_err();
                assert!(matches!(refused, Refusal::Foreign(_)), "{host:?}");
            }
        }
    }

    #[test]
    fn a_page_is_of_the_host_that_it_asks_or_by_its_browser_of_the_proxy_before_it() {
        let (guard, page) = guard();
        let passes = |origin: &str, site: Option<&str>| {
            let head = head(&page, Some("127.0.0.1:4000"), Some(origin), site);
            guard.pass(&head).is_ok()
        };
        let behind_a_proxy = [
            "https://127.0.0.1:4000",
            "http://localhost:80",
            "http://[::1]",
        ];
        for origin in behind_a_proxy {
            assert!(passes(origin, Some("same-origin")), "{origin}");
        }
        let never = [
            "null",
            "",
            "127.0.0.1:4000",
            "ftp://127.0.0.1:4000",
            "http://127.0.0.1:4000/",
            "http://evil.example",
            "http://evil.example@localhost",
        ];
        for origin in never {
            assert!(!passes(origin, Some("same-origin")), "{origin}");
        }
        let others = ["http://127.0.0.1:4001", "http://localhost:4000"];
        for origin in never.into_iter().chain(behind_a_proxy).chain(others) {
            for site in [None, Some("none"), Some("same-site"), Some("cross-site")] {
                assert!(!passes(origin, site), "{origin} {site:?}");
            }
        }
    }

    #[test]
    fn another_site_reaches_the_page_and_nothing_below_it() {
        let (guard, page) = guard();
        let site = |target: &str, site: &str| {
            let head = head(target, Some("localhost"), None, Some(site));
            guard.pass(&head).is_ok()
        };
        let below = format!("{page}api/about");
        for own in ["same-origin", "none"] {
            assert!(site(&page, own) && site(&below, own));
        }
        for other in ["cross-site", "same-site", "?"] {
            assert!(site(&page, other) && !site(&below, other), "{other}");
        }
    }
}
