//! Attributes of a node. Each is read with its type, and none may stay unread.

use crate::{
    NodeRefusal, Tensor,
    load::constant,
    proto::{AttributeProto, AttributeType, NodeProto},
};

/// The attributes of one node.
pub(crate) struct Attributes<'a> {
    node: &'a NodeProto,
    read: Vec<bool>,
}

impl<'a> Attributes<'a> {
    pub(crate) fn new(node: &'a NodeProto) -> Self {
        Self {
            node,
            read: vec![false; node.attribute.len()],
        }
    }

    fn take(
        &mut self,
        name: &str,
        wanted: AttributeType,
    ) -> Result<Option<&'a AttributeProto>, NodeRefusal> {
        let Some(position) = self
            .node
            .attribute
            .iter()
            .position(|attribute| attribute.name == name)
        else {
            return Ok(None);
        };
        self.read[position] = true;
        let attribute = &self.node.attribute[position];
        if attribute.r#type() == wanted {
            return Ok(Some(attribute));
        }
        Err(refusal(
            name,
            format!("is of type {:?}, expected {wanted:?}", attribute.r#type()),
        ))
    }

    pub(crate) fn int(&mut self, name: &str) -> Result<Option<i64>, NodeRefusal> {
        let attribute = self.take(name, AttributeType::Int)?;
        Ok(attribute.map(|attribute| attribute.i.unwrap_or_default()))
    }

    /// An integer that is 0 or 1.
    pub(crate) fn flag(&mut self, name: &str, default: bool) -> Result<bool, NodeRefusal> {
        match self.int(name)? {
            None => Ok(default),
            Some(0) => Ok(false),
            Some(1) => Ok(true),
            Some(value) => Err(refusal(name, format!("{value}, expected 0 or 1"))),
        }
    }

    pub(crate) fn float(&mut self, name: &str) -> Result<Option<f32>, NodeRefusal> {
        let attribute = self.take(name, AttributeType::Float)?;
        Ok(attribute.map(|attribute| attribute.f.unwrap_or_default()))
    }

    pub(crate) fn ints(&mut self, name: &str) -> Result<Option<&'a [i64]>, NodeRefusal> {
        let attribute = self.take(name, AttributeType::Ints)?;
        Ok(attribute.map(|attribute| attribute.ints.as_slice()))
    }

    pub(crate) fn floats(&mut self, name: &str) -> Result<Option<&'a [f32]>, NodeRefusal> {
        let attribute = self.take(name, AttributeType::Floats)?;
        Ok(attribute.map(|attribute| attribute.floats.as_slice()))
    }

    pub(crate) fn tensor(&mut self, name: &str) -> Result<Option<Tensor>, NodeRefusal> {
        let Some(attribute) = self.take(name, AttributeType::Tensor)? else {
            return Ok(None);
        };
        let Some(tensor) = &attribute.t else {
            return Err(refusal(name, "holds no tensor".to_owned()));
        };
        match constant::read(tensor) {
            Ok(constant) => Ok(Some(constant.into_tensor())),
            Err(error) => Err(refusal(name, error.to_string())),
        }
    }

    /// Refuses attributes that the operator did not ask for: they would change its meaning.
    pub(crate) fn finish(self) -> Result<(), NodeRefusal> {
        match self.read.iter().position(|read| !read) {
            None => Ok(()),
            Some(position) => Err(refusal(
                &self.node.attribute[position].name,
                "not known, or given twice".to_owned(),
            )),
        }
    }
}

pub(crate) fn refusal(name: &str, reason: String) -> NodeRefusal {
    NodeRefusal::Attribute {
        name: name.to_owned(),
        reason,
    }
}
