//! Whose request is answered: `Host`, `Origin`, token, `Sec-Fetch-Site`.
//!
//! A page of another site can have the user's browser send requests here. By its own name, it says so in `Origin` or
//! `Sec-Fetch-Site`. By a name of its own that it lets point to 127.0.0.1 (DNS rebinding), it says so in `Host`. And it
//! does not know the token, which the user's browser alone was given.

use crate::{
    error::ApiError,
    http::{Head, Status},
    token::Token,
};
use std::net::SocketAddr;

/// Names of the loopback address by which the server may be called.
const NAMES: [&str; 3] = ["127.0.0.1", "localhost", "[::1]"];
/// The port that addresses leave out.
const USUAL_PORT: u16 = 80;

/// What tells this server's requests from those of others.
pub(crate) struct Guard {
    /// `Host` of a request to this server.
    hosts: Vec<String>,
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

impl Guard {
    /// The guard of a server at this address.
    pub(crate) fn new(address: SocketAddr, token: Token) -> Self {
        let port = address.port();
        let mut hosts: Vec<String> = NAMES.iter().map(|name| format!("{name}:{port}")).collect();
        if port == USUAL_PORT {
            hosts.extend(NAMES.map(str::to_owned));
        }
        Self { hosts, token }
    }

    /// The path of the page, with the token.
    pub(crate) fn page(&self) -> String {
        format!("/{}/", self.token.text())
    }

    /// Where the request goes.
    pub(crate) fn pass<'a>(&self, head: &'a Head) -> Result<Target<'a>, Refusal> {
        let ours = |host: &str| self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host));
        if !head.host.as_deref().is_some_and(ours) {
            return Err(foreign("the request names another host"));
        }
        if let Some(origin) = &head.origin
            && !origin.strip_prefix("http://").is_some_and(ours)
        {
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
        let site = head.fetch_site.as_deref();
        if !is_page && site.is_some_and(|site| !matches!(site, "same-origin" | "none")) {
            return Err(foreign("another site asked for this"));
        }
        Ok(below)
    }
}

fn foreign(error: &str) -> Refusal {
    Refusal::Foreign(ApiError::new(
        Status::Forbidden,
        error,
        "open the address that `asperity studio` printed",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guard(port: u16) -> (Guard, String) {
        let token = Token::random().unwrap();
        let guard = Guard::new(([127, 0, 0, 1], port).into(), token);
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
    fn names_of_this_machine_pass_and_all_others_are_foreign() {
        let (guard, page) = guard(4000);
        for host in [
            "127.0.0.1:4000",
            "localhost:4000",
            "LOCALHOST:4000",
            "[::1]:4000",
        ] {
            let head = head(&page, Some(host), Some(&format!("http://{host}")), None);
            assert_eq!(guard.pass(&head), Ok(Target::Below("")), "{host}");
        }
        let hosts = [
            "127.0.0.1",
            "127.0.0.1:4001",
            "evil.example:4000",
            "127.0.0.1.evil.example:4000",
            "127.0.0.1:4000.evil.example",
            "localhost:4000@evil.example",
            "0.0.0.0:4000",
            "127.1:4000",
            "",
        ];
        for host in hosts.map(Some).into_iter().chain([None]) {
            let refused = guard.pass(&head(&page, host, None, None)).unwrap_err();
            assert!(matches!(refused, Refusal::Foreign(_)), "{host:?}");
        }
        for origin in [
            "null",
            "",
            "https://127.0.0.1:4000",
            "http://127.0.0.1:4001",
            "http://evil.example",
        ] {
            let head = head(&page, Some("127.0.0.1:4000"), Some(origin), None);
            assert!(
                matches!(guard.pass(&head), Err(Refusal::Foreign(_))),
                "{origin}"
            );
        }
    }

    #[test]
    fn another_site_reaches_the_page_and_nothing_below_it() {
        let (guard, page) = guard(80);
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
