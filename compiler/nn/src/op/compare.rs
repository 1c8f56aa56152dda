//! Equal, Less, LessOrEqual, Greater, GreaterOrEqual, Where.

use crate::{
    ElementType, NodeRefusal, OpError, Tensor,
    op::{Inputs, Operator, Types, layout},
    tensor::{Element, same_type},
};

/// Which comparison.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Order {
    Equal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// a ∘ b on numbers of one type, as bool.
#[derive(Debug)]
pub(crate) struct Compare(pub(crate) Order);

impl Operator for Compare {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        let element_type = inputs.number(0)?;
        inputs.same(1, element_type)?;
        Ok(ElementType::Bool)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        match inputs.tensor(0)?.element_type() {
            ElementType::F32 => self.apply::<f32>(inputs),
            ElementType::I64 => self.apply::<i64>(inputs),
            _ => self.apply::<i32>(inputs),
        }
    }
}

impl Compare {
    fn apply<T: Element + PartialOrd>(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let (a_shape, b_shape) = (inputs.shape(0)?, inputs.shape(1)?);
        let shape = layout::broadcast(a_shape, b_shape)?;
        inputs.size(&shape)?;
        let (a, b) = (
            (a_shape, inputs.elements::<T>(0)?),
            (b_shape, inputs.elements::<T>(1)?),
        );
        // A reference gives one loop for each type instead of five.
        let holds: &dyn Fn(T, T) -> bool = match self.0 {
            Order::Equal => &|x, y| x == y,
            Order::Less => &|x, y| x < y,
            Order::LessOrEqual => &|x, y| x <= y,
            Order::Greater => &|x, y| x > y,
            Order::GreaterOrEqual => &|x, y| x >= y,
        };
        let data = layout::zip(&shape, a, b, holds);
        Ok(Tensor::Bool { shape, data })
    }
}

/// x where the condition holds, else y; all three broadcast.
#[derive(Debug)]
pub(crate) struct Where;

impl Operator for Where {
    fn output_type(&self, inputs: &Types<'_>) -> Result<ElementType, NodeRefusal> {
        inputs.one_of(0, &[ElementType::Bool], "bool")?;
        let element_type = inputs.any(1)?;
        inputs.same(2, element_type)?;
        Ok(element_type)
    }

    fn run(&self, inputs: &Inputs<'_>) -> Result<Tensor, OpError> {
        let shapes = [inputs.shape(0)?, inputs.shape(1)?, inputs.shape(2)?];
        let shape = layout::broadcast(&layout::broadcast(shapes[0], shapes[1])?, shapes[2])?;
        inputs.size(&shape)?;
        let choose = layout::copy(
            inputs.elements::<bool>(0)?,
            0,
            &shape,
            &layout::broadcast_strides(shapes[0], &shape),
        );
        let (x_strides, y_strides) = (
            layout::broadcast_strides(shapes[1], &shape),
            layout::broadcast_strides(shapes[2], &shape),
        );
        let spread = |tensor: &Tensor, strides: &[isize]| same_type!(tensor, data => (shape.clone(), layout::copy(data, 0, &shape, strides)));
        let (x, y) = (
            spread(inputs.tensor(1)?, &x_strides),
            spread(inputs.tensor(2)?, &y_strides),
        );
        select(&choose, x, &y).ok_or(OpError::Input(2))
    }
}

/// `x` with the elements of `y` where `choose` is false; `None` when their types differ.
fn select(choose: &[bool], mut x: Tensor, y: &Tensor) -> Option<Tensor> {
    fn merge<T: Copy>(choose: &[bool], x: &mut [T], y: &[T]) {
        for ((x, &y), &keep) in x.iter_mut().zip(y).zip(choose) {
            if !keep {
                *x = y;
            }
        }
    }
    match (&mut x, y) {
        (Tensor::F32 { data, .. }, Tensor::F32 { data: y, .. }) => merge(choose, data, y),
        (Tensor::I64 { data, .. }, Tensor::I64 { data: y, .. }) => merge(choose, data, y),
        (Tensor::I32 { data, .. }, Tensor::I32 { data: y, .. }) => merge(choose, data, y),
        (Tensor::Bool { data, .. }, Tensor::Bool { data: y, .. }) => merge(choose, data, y),
        (Tensor::I8 { data, .. }, Tensor::I8 { data: y, .. })
        | (Tensor::U8 { data, .. }, Tensor::U8 { data: y, .. }) => {
            let mut bytes = data.to_vec();
            merge(choose, &mut bytes, y);
            *data = bytes.into();
        }
        _ => return None,
    }
    Some(x)
}
