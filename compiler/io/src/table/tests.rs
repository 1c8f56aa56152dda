//! Dialects: what is read alike, and what is refused by its line.

use super::*;

const UNITS: [&str; 4] = ["s", "N", "(mm)", "g"];

fn open(text: &[u8]) -> Result<Table<&[u8]>, TableError> {
    Table::open(text, &|field| UNITS.contains(&field))
}

/// Names, line of the first row, and all numbers.
type Read = (Vec<String>, u64, Vec<Vec<f64>>);

fn read(text: &str) -> Result<Read, TableError> {
    let mut table = open(text.as_bytes())?;
    let (mut rows, mut first) = (Vec::new(), 0);
    let columns = table.layout().columns.clone();
    while let Some(row) = table.next_row()? {
        if rows.is_empty() {
            first = row.line;
        }
        let numbers = (0..columns.len()).map(|column| row.number(column).unwrap_or(f64::INFINITY));
        rows.push(numbers.collect());
    }
    Ok((columns, first, rows))
}

#[test]
fn every_dialect_is_read_alike() {
    let rows = vec![vec![0.0, 0.5], vec![0.001, -1.25], vec![0.002, 3.0]];
    for (text, line) in [
        ("t,x\n0,0.5\n0.001,-1.25\n0.002,3\n", 2),
        ("t,x\r\n0,0.5\r\n0.001,-1.25\r\n0.002,3", 2),
        ("t,x\r0,0.5\r0.001,-1.25\r0.002,3\r", 2),
        ("\u{feff}\"t\";\"x\"\n0;0.5\n0.001;-1.25\n0.002;3\n", 2),
        ("t;x\n0;0,5\n0,001;-1,25\n0,002;3\n", 2),
        ("t,x\n0,\"0,5\"\n\"0,001\",\"-1,25\"\n\"0,002\",3\n", 2),
        ("sep=;\nt;x\n0;0.5\n0.001;-1.25\n0.002;3\n", 3),
        ("t\tx\n0\t0,5\n0,001\t-1,25\n0,002\t3\n", 2),
        ("  t    x\n 0   0.5\n 0.001 -1.25\n 0.002  3\n", 2),
        ("# t x\n 0 0.5\n 0.001 -1.25 \n 0.002 3\n", 2),
        (
            "# made, at, a desk\n#t,x\n# 3 rows\n0,0.5\n0.001,-1.25\n0.002,3\n",
            4,
        ),
        ("% t x\n0 0.5\n0.001 -1.25\n0.002 3\n", 2),
        ("# t, x\n0 0.5\n0.001 -1.25\n0.002 3\n", 2),
        ("t,x,\n0,0.5,\n0.001,-1.25,\n0.002,3,\n", 2),
        ("t,x\n# begin\n\n0,0.5\n0.001,-1.25\n0.002,3\n", 4),
        (
            "File name: a, b\nRate: 1000\n\nt,x\n0,0.5\n0.001,-1.25\n0.002,3\n",
            5,
        ),
        ("t,x\ns,N\n0,0.5\n0.001,-1.25\n0.002,3\n", 3),
        ("t:0,x:0.5\nt:0.001,x:-1.25\nt:0.002,x:3\n", 1),
        ("ready\nt:0\tx:0.5\nt:0.001\tx:-1.25\nt:0.002\tx:3\n", 2),
        ("t\tx\tComment\n0\t0.5\n0.001\t-1.25\n0.002\t3\n", 2),
    ] {
        let (mut names, first, mut found) = read(text).unwrap_or_else(|e| panic!("{text:?} {e}"));
        if names.len() == 3 && names[2].is_empty() {
            names.pop();
            for row in &mut found {
                row.pop();
            }
        }
        assert_eq!(names, ["t", "x"], "{text:?}");
        assert_eq!((first, &found), (line, &rows), "{text:?}");
    }
}

#[test]
fn what_stands_around_a_header_is_kept_for_who_asks() {
    let table = open(b"\xef\xbb\xbftime,Fx\n\"s\",\"N\"\n0,1\n1,2\n2,3\n").expect("a table");
    assert_eq!(table.layout().units, ["s", "N"]);
    let text = b"Format,1.2,Rate,240\n\n,,Rigid,Rigid\n,,Position,Position\nFrame,Time,X,Y\n0,0,1,2\n1,1,1,2\n2,2,1,2\n";
    let table = open(text).expect("a table");
    assert_eq!(table.layout().columns, ["Frame", "Time", "X", "Y"]);
    assert_eq!(table.layout().groups[2], "Rigid Position");
    assert_eq!(table.layout().header, 5);
    // A name in Latin-1.
    let table = open(b"t;a (m/s\xb2)\n0;1\n1;2\n").expect("a table");
    assert_eq!(table.layout().columns[1], "a (m/s²)");
    // Columns that numbers name.
    assert_eq!(
        read("t,0,1\n0,1,2\n1,2,3\n").expect("a table").0,
        ["t", "0", "1"]
    );
    // A comment behind one row.
    let text = "X_Value\tx\tComment\n0\t1\n1\t2\thit\n2\t3\n3\t4\n";
    assert_eq!(read(text).expect("a table").2.len(), 4);
    // A time as text, and a column of labels.
    let (names, _, rows) =
        read("time,label,x\n08:00:00.5,a,1\n08:00:01,b,2\n08:00:02,a,3\n").expect("a table");
    assert_eq!((names.len(), rows[1][0], rows[2][2]), (3, 28_801.0, 3.0));
}

#[test]
fn what_cannot_be_told_is_refused_by_its_line() {
    for (text, part) in [
        (
            "1,2\n3,4\n",
            "line 1 begins with numbers that commas separate",
        ),
        (
            "# made at 3\n 1 2\n 3 4\n",
            "line 2 begins with numbers that spaces separate",
        ),
        ("# a,b,c\n1,2\n3,4\n", "begins with numbers"),
        ("# a\n", "has no header"),
        (
            "t,x\n0,1\n1\n2,3\n",
            "line 3 has 1 values where the header has 2",
        ),
        (
            "t,x,y\n0,1\n1,2\n2,3\n",
            "line 2 has 2 values where the header has 3",
        ),
        (
            "t,x\n0,1\n1,2\n\nspeed,force\n1,2\n2,3\n",
            "line 5 holds names in place of numbers",
        ),
        ("t\0x\n", "bytes of 0"),
        ("\u{feff}", "has no header"),
    ] {
        let error = read(text).expect_err(text).to_string();
        assert!(error.contains(part), "{text:?}: {error}");
    }
    let error = open(b"\xff\xfet\0,\0x\0\n\0").expect_err("UTF-16");
    assert!(error.to_string().contains("UTF-16"), "{error}");
    // A word where a number should be is no header.
    let (_, first, rows) = read("t,x\nbad,1\n1,2\n2,3\n").expect("a table");
    assert_eq!((first, rows[0][0]), (2, f64::INFINITY));
    // Another label than the column's.
    let (_, _, rows) = read("t:0,x:1\nt:1,x:2\nt:2,y:3\n").expect("a table");
    assert_eq!(rows[2][1], f64::INFINITY);
}

#[test]
fn rows_know_their_lines() {
    for end in ["\n", "\r\n", "\r"] {
        for blank in [0, 2] {
            let between = format!("{end}{}", end.repeat(blank));
            let text = ["t,x", "0,1", "1,2", "# c", "2,3"].join(&between);
            let mut table = open(text.as_bytes()).expect("a table");
            let mut lines = Vec::new();
            while let Some(row) = table.next_row().expect("rows") {
                lines.push(row.line);
            }
            let step = 1 + blank as u64;
            assert_eq!(lines[..2], [1 + step, 1 + 2 * step], "{text:?}");
        }
    }
}

#[test]
fn the_last_row_alone_may_be_cut() {
    let mut table = open(b"# c\nt,x\n0,1,\n1,2\n2").expect("a table");
    let mut count = 0;
    while table.next_row().expect("rows").is_some() {
        count += 1;
    }
    assert_eq!((count, table.cut()), (2, Some((5, 1))));
}
