//! Small systems of linear equations.

/// The solution of a symmetric positive system, by Gauss's elimination with pivots; `None` for a
/// singular one.
pub(crate) fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let count = right.len();
    for column in 0..count {
        let pivot = (column..count)
            .max_by(|&a, &b| matrix[a][column].abs().total_cmp(&matrix[b][column].abs()))?;
        if matrix[pivot][column].abs() < 1e-300 {
            return None;
        }
        matrix.swap(column, pivot);
        right.swap(column, pivot);
        for row in column + 1..count {
            let factor = matrix[row][column] / matrix[column][column];
            let (above, below) = matrix.split_at_mut(row);
            for (x, pivot) in below[0].iter_mut().zip(&above[column]).skip(column) {
                *x -= factor * pivot;
            }
            right[row] -= factor * right[column];
        }
    }
    let mut solution = vec![0.0; count];
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|k| matrix[row][k] * solution[k]).sum();
        solution[row] = (right[row] - known) / matrix[row][row];
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::solve;
    use crate::test_recordings::near;

    fn all_near(found: Option<Vec<f64>>, expected: &[f64]) {
        let found = found.expect("regular");
        assert_eq!(found.len(), expected.len(), "{found:?}");
        for (a, b) in found.iter().zip(expected) {
            near(*a, *b, 1e-12);
        }
    }

    #[test]
    fn systems_are_solved_with_and_without_pivots() {
        let rows = |rows: [[f64; 3]; 3]| rows.map(|row| row.to_vec()).to_vec();
        let found = solve(
            rows([[2.0, 1.0, 0.0], [1.0, 3.0, 1.0], [0.0, 1.0, 4.0]]),
            vec![0.0, -2.0, 10.0],
        );
        all_near(found, &[1.0, -2.0, 3.0]);
        let found = solve(
            rows([[0.0, 1.0, 2.0], [1.0, 0.0, 3.0], [4.0, 5.0, 6.0]]),
            vec![8.0, 10.0, 32.0],
        );
        all_near(found, &[1.0, 2.0, 3.0]);
        // The largest of a column is the pivot, whatever its sign: 10²⁰ would swallow the rest.
        let found = solve(vec![vec![1e-20, 1.0], vec![-1.0, 1.0]], vec![1.0, 0.0]);
        all_near(found, &[1.0, 1.0]);
        assert_eq!(
            solve(vec![vec![1.0, 2.0], vec![2.0, 4.0]], vec![1.0, 2.0]),
            None
        );
        assert_eq!(solve(vec![vec![1e-301]], vec![1e-301]), None);
        assert_eq!(solve(vec![vec![1e-299]], vec![1e-299]), Some(vec![1.0]));
        assert_eq!(solve(vec![vec![1e-299]], vec![1e200]), None);
        assert_eq!(solve(Vec::new(), Vec::new()), Some(Vec::new()));
    }
}
