//! The pictures of a material in a folder, by their usual names.

use super::Convention;
use asperity_io::diagnostic::Fault;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// Endings of pictures that are read, the most exact first.
const ENDINGS: [&str; 5] = ["tif", "tiff", "png", "jpg", "jpeg"];
/// Parts of names of maps of heights, the most exact first.
const HEIGHT: [&str; 8] = [
    "displacement",
    "disp",
    "height",
    "heightmap",
    "parallax",
    "depth",
    "bump",
    "h",
];
const NORMAL: [&str; 6] = ["normal", "normals", "normalmap", "nor", "nrm", "n"];
const NORMAL_GL: [&str; 3] = ["normalgl", "gl", "opengl"];
const NORMAL_DX: [&str; 3] = ["normaldx", "dx", "directx"];
const COLOR: [&str; 11] = [
    "color",
    "colour",
    "basecolor",
    "basecolour",
    "albedo",
    "diffuse",
    "diff",
    "col",
    "base",
    "bc",
    "d",
];

/// Parts of names of maps that say nothing of heights.
const OTHERS: [&str; 12] = [
    "roughness",
    "rough",
    "gloss",
    "glossiness",
    "ao",
    "occlusion",
    "metallic",
    "metalness",
    "specular",
    "opacity",
    "arm",
    "orm",
];

/// A material's pictures.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Material {
    /// Its heights.
    pub height: Option<PathBuf>,
    /// Its normals.
    pub normal: Option<PathBuf>,
    /// Where green points to in these, by their name.
    pub convention: Option<Convention>,
    /// What it looks like.
    pub color: Option<PathBuf>,
}

impl Material {
    /// The pictures of a folder. Where there are several of a kind, the most exact format and then the first by name is
    /// taken; of normals, those whose name shows the convention.
    ///
    /// # Errors
    /// [`Fault`] for a folder that cannot be read, or that has neither heights nor normals.
    pub fn of(folder: &Path) -> Result<Self, Fault> {
        let mut files = entries(folder)?;
        // As Poly Haven packs them.
        let inner = folder.join("textures");
        if !files.iter().any(|file| rank(file).is_some()) && inner.is_dir() {
            return Self::of(&inner);
        }
        let has_exr = files.iter().any(|file| {
            file.extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("exr"))
        });
        files.retain(|file| rank(file).is_some());
        files.sort_by_key(|file| (rank(file), file.clone()));
        let named = |names: &[&str]| {
            let with = |name: &&str| {
                let fits = |file: &&PathBuf| words(file).iter().any(|word| word == name);
                files.iter().find(fits)
            };
            names.iter().find_map(with).cloned()
        };
        let normals = |convention: &[&str]| {
            let of = |file: &&PathBuf| {
                let words = words(file);
                let has = |names: &[&str]| words.iter().any(|word| names.contains(&&**word));
                has(convention) && (has(&NORMAL) || has(&convention[..1]))
            };
            files.iter().find(of).cloned()
        };
        let (normal, convention) = if let Some(file) = normals(&NORMAL_GL) {
            (Some(file), Some(Convention::Gl))
        } else if let Some(file) = normals(&NORMAL_DX) {
            (Some(file), Some(Convention::Dx))
        } else {
            (named(&NORMAL), None)
        };
        let material = Self {
            height: named(&HEIGHT),
            normal,
            convention,
            color: named(&COLOR),
        };
        let names: BTreeSet<String> = material.files().map(|file| name_of(file)).collect();
        if names.len() > 1 {
            let what = format!("its pictures are of several materials: {names:?}");
            return Err(Fault::new(what, "give each a folder of its own").at(folder));
        }
        if material.height.is_none() && material.normal.is_none() {
            let seen = match files.len() {
                0 => "no PNG, TIFF or JPEG".to_owned(),
                count => format!("none of its {count} pictures is named as heights or normals"),
            };
            if has_exr {
                let what = "its heights may be in an EXR, which is not read";
                return Err(Fault::new(what, "convert it to a TIFF of floating point").at(folder));
            }
            let remedy = "name them as material libraries do, such as oak_height.png and oak_normal_gl.png, or give one picture";
            return Err(Fault::new(seen, remedy).at(folder));
        }
        Ok(material)
    }

    /// Every picture that is read.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.height, &self.normal, &self.color]
            .into_iter()
            .flatten()
    }
}

/// The maps and the folders of materials in a folder, by name; a folder without folders, whose names show more than heights,
/// is one material.
///
/// # Errors
/// [`Fault`] for a folder that cannot be read, or that has neither.
pub fn all(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    if !folder.is_dir() {
        return Ok(vec![folder.to_owned()]);
    }
    let mut paths = entries(folder)?;
    paths.retain(|path| path.is_dir() || rank(path).is_some());
    let has = |names: &[&str]| {
        let named = |path: &PathBuf| words(path).iter().any(|word| names.contains(&&**word));
        paths.iter().any(named)
    };
    let is_material =
        (has(&HEIGHT) || has(&NORMAL)) && (has(&NORMAL) || has(&COLOR) || has(&OTHERS));
    if is_material && !paths.iter().any(|path| path.is_dir()) {
        return Material::of(folder).map(|_| vec![folder.to_owned()]);
    }
    if paths.is_empty() {
        let remedy =
            "give a folder of height maps, or of folders with the pictures of a material each";
        return Err(Fault::new("no PNG, TIFF or JPEG, and no folder", remedy).at(folder));
    }
    paths.sort();
    let same = |pair: &&[PathBuf]| pair[0].file_stem() == pair[1].file_stem();
    if let Some([one, other]) = paths.windows(2).find(same) {
        let what = format!(
            "{} and {} would have one name",
            one.display(),
            other.display()
        );
        return Err(Fault::new(what, "rename one of them, or move it elsewhere").at(folder));
    }
    Ok(paths)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let unread = |error: std::io::Error| {
        Fault::new(
            format!("the folder cannot be read: {error}"),
            "check the path",
        )
        .at(folder)
    };
    let hidden = |path: &PathBuf| {
        path.file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'))
    };
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(unread)? {
        paths.push(entry.map_err(unread)?.path());
    }
    paths.retain(|path| !hidden(path));
    Ok(paths)
}

/// Place of a picture's format among those that are read.
fn rank(file: &Path) -> Option<usize> {
    let ending = file.extension()?.to_str()?.to_ascii_lowercase();
    ENDINGS.iter().position(|known| *known == ending)
}

/// The words before the first that tells what a picture shows.
fn name_of(file: &Path) -> String {
    let all = words(file);
    // The words by themselves are followed by every two of them.
    let (single, pairs) = all.split_at(all.len().div_ceil(2));
    let known = |word: &String| {
        let lists: [&[&str]; 4] = [&HEIGHT, &NORMAL, &COLOR, &OTHERS];
        lists.iter().any(|list| list.contains(&&**word))
    };
    let is_known = |at: &usize| known(&single[*at]) || pairs.get(*at).is_some_and(known);
    let first = (0..single.len()).find(is_known).unwrap_or(single.len());
    single[..first].concat()
}

/// The words of a file's name: `Planks01_Base-ColorGL.png` has planks01, base, color, gl, and every two of them joined.
fn words(file: &Path) -> Vec<String> {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let mut words = vec![String::new()];
    let mut before = ' ';
    for c in stem.chars() {
        let starts = !c.is_alphanumeric() || c.is_uppercase() && before.is_lowercase();
        if starts && words.last().is_some_and(|word| !word.is_empty()) {
            words.push(String::new());
        }
        if let (true, Some(word)) = (c.is_alphanumeric(), words.last_mut()) {
            word.extend(c.to_lowercase());
        }
        before = c;
    }
    let joined: Vec<String> = words.windows(2).map(|pair| pair.concat()).collect();
    words.extend(joined);
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claim: the pictures of common libraries are recognised by name.
    #[test]
    fn pictures_are_told_by_their_names() {
        let folder = tempfile::tempdir().unwrap();
        for (files, [height, normal, color], convention) in [
            (
                &[
                    "Wood049_2K-PNG_Color.png",
                    "Wood049_2K-PNG_Displacement.png",
                    "Wood049_2K-PNG_NormalDX.png",
                    "Wood049_2K-PNG_NormalGL.png",
                    "Wood049_2K-PNG_Roughness.png",
                ][..],
                [
                    Some("Wood049_2K-PNG_Displacement.png"),
                    Some("Wood049_2K-PNG_NormalGL.png"),
                    Some("Wood049_2K-PNG_Color.png"),
                ],
                Some(Convention::Gl),
            ),
            (
                &[
                    "brick_wall_diff_1k.jpg",
                    "brick_wall_disp_1k.png",
                    "brick_wall_nor_dx_1k.png",
                    "brick_wall_rough_1k.jpg",
                    "brick_wall_ao_1k.jpg",
                ],
                [
                    Some("brick_wall_disp_1k.png"),
                    Some("brick_wall_nor_dx_1k.png"),
                    Some("brick_wall_diff_1k.jpg"),
                ],
                Some(Convention::Dx),
            ),
            (
                &[
                    "leather-BaseColor.jpg",
                    "leather-Height.jpg",
                    "leather-Height.tif",
                    "leather-Normal.png",
                    "notes.txt",
                ],
                [
                    Some("leather-Height.tif"),
                    Some("leather-Normal.png"),
                    Some("leather-BaseColor.jpg"),
                ],
                None,
            ),
            (
                &[
                    "T_Oak_N.png",
                    "T_Oak_H.png",
                    "T_Oak_BC.png",
                    "T_Oak_ORM.png",
                ],
                [
                    Some("T_Oak_H.png"),
                    Some("T_Oak_N.png"),
                    Some("T_Oak_BC.png"),
                ],
                None,
            ),
        ] {
            let folder = folder.path().join(files[0]);
            fs::create_dir(&folder).unwrap();
            for file in files {
                fs::write(folder.join(file), "").unwrap();
            }
            let found = Material::of(&folder).unwrap();
            let path = |name: Option<&str>| name.map(|name| folder.join(name));
            assert_eq!(
                (found.height, found.normal, found.color),
                (path(height), path(normal), path(color))
            );
            assert_eq!(found.convention, convention);
        }
        let bare = folder.path().join("bare");
        fs::create_dir(&bare).unwrap();
        fs::write(bare.join("photo.jpg"), "").unwrap();
        let mixed = folder.path().join("mixed");
        fs::create_dir(&mixed).unwrap();
        for file in ["oak_bump.png", "oak_height.png", "stone_normal_gl.png"] {
            fs::write(mixed.join(file), "").unwrap();
        }
        let fault = Material::of(&mixed).unwrap_err().to_string();
        assert!(
            fault.contains("several materials: {\"oak\", \"stone\"}"),
            "{fault}"
        );
        fs::remove_file(mixed.join("stone_normal_gl.png")).unwrap();
        let heights = Material::of(&mixed).unwrap().height;
        assert_eq!(heights, Some(mixed.join("oak_height.png")));
        assert!(
            Material::of(&bare)
                .unwrap_err()
                .to_string()
                .contains("none of its 1 pictures")
        );
    }
}
