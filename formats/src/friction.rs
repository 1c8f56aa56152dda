//! FRIC: μ, the anchors it was interpolated from and, from version 2 on, its law over speed.

use crate::{
    error::{FormatError, in_range},
    friction_law::{FrictionLaw, LawPoint},
    header::{VERSION_WITH_LAW, VERSION_WITH_OPTIONAL, VERSION_WITHOUT_LAW},
    limits,
    wire::Reader,
};

/// Coulomb friction, or friction that depends on speed.
#[derive(Debug, Clone, Copy)]
pub struct Friction<'a> {
    mu: f32,
    count: usize,
    anchors: &'a [u8],
    law: Option<FrictionLaw<'a>>,
}

/// A named reference material with a known μ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor<'a> {
    /// Name of the material.
    pub name: &'a str,
    /// Its coefficient of kinetic friction.
    pub mu: f32,
    /// Its weight in the texture's μ, 0..=1.
    pub weight: f32,
}

impl<'a> Friction<'a> {
    /// Reads the section of an asset of this version.
    pub(crate) fn parse(bytes: &'a [u8], version: u16) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let mut friction = Self::without_law(&mut reader, bytes)?;
        // Version 3 is there for another reason, so its friction may have a law or none.
        let has_law = match version {
            ..VERSION_WITH_LAW => false,
            VERSION_WITH_LAW => true,
            VERSION_WITH_OPTIONAL.. => !reader.is_empty(),
        };
        if has_law {
            friction.law = Some(FrictionLaw::parse(&mut reader, friction.mu)?);
        }
        reader.finish("friction")?;
        Ok(friction)
    }

    /// The version that an asset with this section has.
    pub(crate) fn version_of(bytes: &[u8]) -> u16 {
        let mut reader = Reader::new(bytes);
        let law_follows =
            Friction::without_law(&mut reader, bytes).is_ok() && reader.finish("friction").is_err();
        if law_follows {
            VERSION_WITH_LAW
        } else {
            VERSION_WITHOUT_LAW
        }
    }

    fn without_law(reader: &mut Reader<'a>, bytes: &'a [u8]) -> Result<Self, FormatError> {
        let mu = in_range(
            "friction.mu",
            0,
            reader.f32("friction.mu")?,
            (0.0, limits::MAX_MU),
            "0 to 10",
        )?;
        let count = usize::from(reader.u8("friction.anchor_count")?);
        if count > limits::MAX_ANCHORS {
            return Err(FormatError::invalid(
                "friction.anchor_count",
                0,
                count as f64,
                "at most 16",
            ));
        }
        let anchors = bytes.get(5..).unwrap_or_default();
        for index in 0..count {
            read_anchor(reader, index)?;
        }
        Ok(Self {
            mu,
            count,
            anchors,
            law: None,
        })
    }

    /// Coefficient of kinetic friction; where there is a law, what its factors multiply.
    #[must_use]
    pub const fn mu(&self) -> f32 {
        self.mu
    }

    /// Returns the dependence of μ on speed, if any.
    #[must_use]
    pub const fn law(&self) -> Option<FrictionLaw<'a>> {
        self.law
    }

    /// The largest μ at any speed.
    pub(crate) fn highest_mu(&self) -> f32 {
        let points = self.law.into_iter().flat_map(|law| law.points());
        let factor = points.map(LawPoint::factor).reduce(f32::max);
        self.mu * factor.unwrap_or(1.0)
    }

    /// The anchors, in stored order.
    pub fn anchors(&self) -> impl ExactSizeIterator<Item = Anchor<'a>> + use<'a> {
        let mut reader = Reader::new(self.anchors);
        // Validated by `parse`, so the fallback is never taken.
        (0..self.count).map(move |index| {
            read_anchor(&mut reader, index).unwrap_or(Anchor {
                name: "",
                mu: 0.0,
                weight: 0.0,
            })
        })
    }
}

fn read_anchor<'a>(reader: &mut Reader<'a>, index: usize) -> Result<Anchor<'a>, FormatError> {
    let mu = reader.f32("friction.anchor.mu")?;
    let weight = reader.f32("friction.anchor.weight")?;
    let len = usize::from(reader.u8("friction.anchor.name_len")?);
    let name = reader.bytes("friction.anchor.name", len)?;
    Ok(Anchor {
        name: text("friction.anchor.name", index, name)?,
        mu: in_range(
            "friction.anchor.mu",
            index,
            mu,
            (0.0, limits::MAX_MU),
            "0 to 10",
        )?,
        weight: in_range(
            "friction.anchor.weight",
            index,
            weight,
            (0.0, 1.0),
            "0 to 1",
        )?,
    })
}

/// A name: 1 to 64 bytes of UTF-8 without control characters.
pub(crate) fn text<'a>(
    field: &'static str,
    index: usize,
    bytes: &'a [u8],
) -> Result<&'a str, FormatError> {
    let reject = |reason| FormatError::Text {
        field,
        index: index as u32,
        reason,
    };
    if bytes.is_empty() {
        return Err(reject("empty"));
    }
    if bytes.len() > limits::MAX_NAME_BYTES {
        return Err(reject("longer than 64 bytes"));
    }
    let name = core::str::from_utf8(bytes).map_err(|_| reject("not UTF-8"))?;
    if name.chars().any(char::is_control) {
        return Err(reject("holds a control character"));
    }
    Ok(name)
}
