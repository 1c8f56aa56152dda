//! Columns of the tables that go in and come out.

/// Columns that a trajectory must have, one row a tick.
pub const INPUT_COLUMNS: [&str; 4] = ["t_s", "x_mm", "y_mm", "z_mm"];
/// Columns of the result.
pub const OUTPUT_COLUMNS: [&str; 12] = [
    "tick",
    "t_s",
    "depth_mm",
    "speed_mm_s",
    "normal_force_n",
    "vib_m_s2",
    "tap_n",
    "friction_n",
    "fx_n",
    "fy_n",
    "fz_n",
    "flags",
];
/// Additional column of a scene: the surface in contact, from 0; empty where there is none.
pub const SURFACE_COLUMN: &str = "surface";
