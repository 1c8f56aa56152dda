//! A recording as a table.

use asperity_host::session_log::csv;

use super::session::{entries, file, read};

#[test]
fn the_table_has_a_row_for_every_tick_and_its_floats_read_back() {
    let entries = entries(2000);
    let recording = read(&file(&entries)).expect("a recording");
    let mut table = Vec::new();
    csv::write(&recording, &mut table).expect("a vector takes all");
    let table = String::from_utf8(table).expect("text");
    let mut rows = table.lines();
    let columns: Vec<&str> = rows.next().expect("a head").split(',').collect();
    let column = |name: &str| {
        columns
            .iter()
            .position(|column| *column == name)
            .expect(name)
    };
    for (n, (row, entry)) in rows.zip(&entries).enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        assert_eq!(cells.len(), columns.len(), "{row}");
        assert_eq!(cells[column("tick")], n.to_string());
        for (axis, name) in ["fx_n", "fy_n", "fz_n"].iter().enumerate() {
            let force: f32 = cells[column(name)].parse().expect("a number");
            assert_eq!(force.to_bits(), entry.force_n[axis].to_bits());
        }
        let read_fault = entry
            .read_fault
            .map(|fault| fault.to_string())
            .unwrap_or_default();
        assert_eq!(cells[column("read_fault")], read_fault);
    }
    assert_eq!(table.lines().count(), 2001);
    assert!(
        table
            .lines()
            .last()
            .expect("a row")
            .split(',')
            .nth(column("texture"))
            == Some("1")
    );
}
