//! SCEN: which surfaces a scene has, where they are, and which texture each one wears.

use crate::{
    checksum::crc32,
    error::{FormatError, in_range},
    limits,
    solid::Solid,
    wire::{Reader, Writer, array_at, f32_at, u16_at},
};

/// Bytes in front of the surfaces: tag, length, CRC, count, reserved.
const HEAD_LEN: usize = 16;
/// Bytes under the length of the section that are not surfaces: count, reserved.
const COUNT_LEN: usize = 4;
const RECORD_LEN: usize = 52;
const TAG: [u8; 4] = *b"SCEN";

/// A solid that wears a texture, within a region along the world's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneSurface {
    /// The solid.
    pub solid: Solid,
    /// Lower corner of the region in which it can be touched, m.
    pub from_m: [f32; 3],
    /// Upper corner of that region, m.
    pub to_m: [f32; 3],
    /// Index of its texture in the library.
    pub texture: u16,
}

/// A validated scene, borrowed from the end of a library.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    records: &'a [u8],
}

/// Bytes of a scene of this many surfaces.
#[must_use]
pub const fn encoded_len(surfaces: usize) -> usize {
    HEAD_LEN + surfaces * RECORD_LEN
}

impl<'a> Scene<'a> {
    /// Checks a section: length, tag, CRC, count, then every surface.
    /// `textures` is the number of textures in the library.
    ///
    /// # Errors
    /// The first check that fails.
    pub fn parse(bytes: &'a [u8], textures: usize) -> Result<Self, FormatError> {
        let mut reader = Reader::new(bytes);
        let found: [u8; 4] = array_at(reader.bytes("scene.tag", 4)?, 0);
        if found != TAG {
            return Err(FormatError::Section {
                tag: found,
                reason: "SCEN expected behind the assets",
            });
        }
        let len = u32::from_le_bytes(array_at(reader.bytes("scene.length", 4)?, 0));
        let stated = u32::from_le_bytes(array_at(reader.bytes("scene.crc", 4)?, 0));
        let content = reader.bytes("scene", len as usize)?;
        reader.finish("scene")?;
        let computed = crc32(&[content]);
        if stated != computed {
            return Err(FormatError::Checksum {
                section: "scene",
                stated,
                computed,
            });
        }
        Self::parse_content(content, textures)
    }

    fn parse_content(content: &'a [u8], textures: usize) -> Result<Self, FormatError> {
        let mut reader = Reader::new(content);
        let count = usize::from(reader.u16("scene.count")?);
        if !(1..=limits::MAX_SURFACES).contains(&count) {
            return Err(FormatError::invalid(
                "scene.count",
                0,
                count as f64,
                "1 to 64 surfaces",
            ));
        }
        reserved(
            "scene.reserved",
            0,
            u32::from(reader.u16("scene.reserved")?),
        )?;
        let records = reader.bytes("scene.surfaces", count * RECORD_LEN)?;
        reader.finish("scene")?;
        for (index, record) in records.chunks_exact(RECORD_LEN).enumerate() {
            let kind = record[0];
            if kind > 2 {
                return Err(FormatError::invalid(
                    "scene.surface.kind",
                    index,
                    f64::from(kind),
                    "0 plane, 1 sphere or 2 box",
                ));
            }
            reserved("scene.surface.reserved", index, u32::from(record[1]))?;
            read(record).check(index, textures)?;
        }
        Ok(Self { records })
    }

    /// Every surface, 1 to 64 of them, in the order of the scene.
    pub fn surfaces(&self) -> impl ExactSizeIterator<Item = SceneSurface> + use<'a> {
        self.records.chunks_exact(RECORD_LEN).map(read)
    }
}

fn reserved(field: &'static str, index: usize, value: u32) -> Result<(), FormatError> {
    if value == 0 {
        Ok(())
    } else {
        Err(FormatError::invalid(
            field,
            index,
            f64::from(value),
            "must be 0",
        ))
    }
}

fn read(record: &[u8]) -> SceneSurface {
    let vector = |at: usize| [0, 4, 8].map(|k| f32_at(record, at + k));
    let (a, b) = (vector(4), vector(16));
    SceneSurface {
        solid: match record.first() {
            Some(0) => Solid::Plane {
                point_m: a,
                normal: b,
            },
            Some(1) => Solid::Sphere {
                center_m: a,
                radius_m: b[0],
            },
            _ => Solid::Box {
                center_m: a,
                half_extents_m: b,
            },
        },
        from_m: vector(28),
        to_m: vector(40),
        texture: u16_at(record, 2),
    }
}

impl SceneSurface {
    fn check(&self, index: usize, textures: usize) -> Result<(), FormatError> {
        if usize::from(self.texture) >= textures {
            return Err(FormatError::invalid(
                "scene.surface.texture",
                index,
                f64::from(self.texture),
                "below the count of textures",
            ));
        }
        let inside = (-limits::MAX_POSITION_M, limits::MAX_POSITION_M);
        let place = |field, v: [f32; 3]| {
            v.into_iter().try_for_each(|x| {
                in_range(field, index, x, inside, "finite, at most 1e4 m from 0").map(drop)
            })
        };
        let size = |field, v: f32| {
            let range = (limits::MIN_SOLID_M, limits::MAX_POSITION_M);
            in_range(field, index, v, range, "1e-6 to 1e4").map(drop)
        };
        match self.solid {
            Solid::Plane { point_m, normal } => {
                place("scene.surface.point_m", point_m)?;
                place("scene.surface.normal", normal)?;
                let longest = normal.into_iter().map(f32::abs).fold(0.0, f32::max);
                size("scene.surface.normal length", longest)?;
            }
            Solid::Sphere { center_m, radius_m } => {
                place("scene.surface.center_m", center_m)?;
                size("scene.surface.radius_m", radius_m)?;
            }
            Solid::Box {
                center_m,
                half_extents_m,
            } => {
                place("scene.surface.center_m", center_m)?;
                half_extents_m
                    .into_iter()
                    .try_for_each(|h| size("scene.surface.half_extents_m", h))?;
            }
        }
        place("scene.surface.from_m", self.from_m)?;
        place("scene.surface.to_m", self.to_m)?;
        for (from, to) in self.from_m.into_iter().zip(self.to_m) {
            if from >= to {
                return Err(FormatError::invalid(
                    "scene.surface.to_m",
                    index,
                    f64::from(to),
                    "above from_m on every axis",
                ));
            }
        }
        Ok(())
    }

    fn write(&self, writer: &mut Writer<'_>) -> Result<(), crate::EncodeError> {
        let (kind, a, b) = match self.solid {
            Solid::Plane { point_m, normal } => (0, point_m, normal),
            Solid::Sphere { center_m, radius_m } => (1, center_m, [radius_m, 0.0, 0.0]),
            Solid::Box {
                center_m,
                half_extents_m,
            } => (2, center_m, half_extents_m),
        };
        writer.u8(kind)?;
        writer.u8(0)?;
        writer.u16(self.texture)?;
        [a, b, self.from_m, self.to_m]
            .into_iter()
            .flatten()
            .try_for_each(|x| writer.f32(x))
    }
}

/// Writes a scene into `out`, [`encoded_len`] bytes.
///
/// # Errors
/// A small buffer; a surface that a reader would refuse.
pub(crate) fn encode(
    surfaces: &[SceneSurface],
    textures: usize,
    out: &mut [u8],
) -> Result<(), crate::EncodeError> {
    let len = encoded_len(surfaces.len());
    let mut writer = Writer::new(out, 0);
    writer.bytes(&TAG)?;
    writer.u32((COUNT_LEN + surfaces.len() * RECORD_LEN) as u32)?;
    writer.u32(0)?;
    writer.u16(surfaces.len() as u16)?;
    writer.u16(0)?;
    for surface in surfaces {
        surface.write(&mut writer)?;
    }
    let crc = crc32(&[out.get(12..len).unwrap_or_default()]);
    Writer::new(out, 8).u32(crc)?;
    Scene::parse(out.get(..len).unwrap_or_default(), textures)?;
    Ok(())
}
