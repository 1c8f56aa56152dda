//! Adam with decoupled weight decay and a bound on the whole gradient's norm, in one
//! pass over the parameters.

use crate::parameters::Parameters;

const BETA_1: f32 = 0.9;
const BETA_2: f32 = 0.999;
const EPSILON: f32 = 1e-8;

/// Running moments of the gradients.
pub(crate) struct Adam {
    /// Steps taken.
    steps: u64,
    /// First moments, in the order of the parameters.
    first: Vec<Vec<f32>>,
    /// Second moments.
    second: Vec<Vec<f32>>,
}

/// Settings of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    /// Step size.
    pub(crate) learning_rate: f64,
    /// Decay of matrices a unit of step size; biases do not decay.
    pub(crate) weight_decay: f64,
    /// Largest norm of the gradient.
    pub(crate) clip_norm: f64,
}

impl Adam {
    /// Before the first step.
    pub(crate) fn new(parameters: &Parameters) -> Self {
        let zeros = || {
            parameters
                .iter()
                .map(|p| vec![0.0; p.values.len()])
                .collect()
        };
        Self {
            steps: 0,
            first: zeros(),
            second: zeros(),
        }
    }

    /// Takes a step down the gradients, which come in the order of the parameters.
    /// Returns the norm of the whole gradient before clipping.
    pub(crate) fn step(
        &mut self,
        parameters: &mut Parameters,
        gradients: &[Option<Vec<f32>>],
        step: Step,
    ) -> f32 {
        self.steps += 1;
        let square: f64 = gradients.iter().flatten().map(|g| squared_norm(g)).sum();
        let norm = libm::sqrt(square);
        let clip = (step.clip_norm / norm.max(step.clip_norm)) as f32;
        let steps = self.steps as f64;
        let unbias = |beta: f32| 1.0 - libm::pow(f64::from(beta), steps);
        let rate = (step.learning_rate / unbias(BETA_1)) as f32;
        let root = (1.0 / unbias(BETA_2)) as f32;
        let decay = 1.0 - (step.learning_rate * step.weight_decay) as f32;
        let moments = self.first.iter_mut().zip(&mut self.second);
        for ((parameter, (first, second)), gradient) in
            parameters.iter_mut().zip(moments).zip(gradients)
        {
            let Some(gradient) = gradient else { continue };
            let decay = if parameter.rows > 1 { decay } else { 1.0 };
            let values = parameter.values.iter_mut();
            for (((x, m), v), g) in values.zip(first).zip(second).zip(gradient) {
                let g = g * clip;
                *m = BETA_1 * *m + (1.0 - BETA_1) * g;
                *v = BETA_2 * *v + (1.0 - BETA_2) * g * g;
                *x = decay * *x - rate * *m / ((*v * root).sqrt() + EPSILON);
            }
        }
        norm as f32
    }
}

fn squared_norm(values: &[f32]) -> f64 {
    // Eight partial sums: a fixed order that vectorises.
    let mut sums = [0.0_f32; 8];
    let mut total = 0.0;
    for block in values.chunks(4096) {
        sums.fill(0.0);
        for lane in block.chunks(8) {
            for (sum, x) in sums.iter_mut().zip(lane) {
                *sum += x * x;
            }
        }
        total += sums.iter().map(|&sum| f64::from(sum)).sum::<f64>();
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: Step = Step {
        learning_rate: 0.1,
        weight_decay: 0.0,
        clip_norm: 1.0,
    };

    #[test]
    fn the_first_step_is_the_learning_rate_against_the_sign() {
        let mut parameters = Parameters::default();
        let slot = parameters.add("x".into(), 1, vec![1.0, 1.0]);
        let mut adam = Adam::new(&parameters);
        let norm = adam.step(&mut parameters, &[Some(vec![30.0, -40.0])], STEP);
        assert_eq!(norm, 50.0);
        let values = &parameters.get(slot).values;
        assert!((values[0] - 0.9).abs() < 1e-5 && (values[1] - 1.1).abs() < 1e-5);
    }

    #[test]
    fn it_finds_the_minimum_of_a_parabola() {
        let mut parameters = Parameters::default();
        let slot = parameters.add("x".into(), 1, vec![2.0]);
        let mut adam = Adam::new(&parameters);
        for _ in 0..500 {
            let gradient = parameters.get(slot).values[0] - 0.5;
            adam.step(&mut parameters, &[Some(vec![gradient])], STEP);
        }
        assert!((parameters.get(slot).values[0] - 0.5).abs() < 1e-2);
    }
}
