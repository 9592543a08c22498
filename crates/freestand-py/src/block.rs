//! The object.

use freestand::G0_M_S2;
use freestand::block::Block;
use freestand_input::problem::Problem;
use freestand_study::shape::Shape;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arguments::Given;

/// The object behind `freestand.Block`.
#[pyclass(frozen, module = "freestand._freestand")]
pub(crate) struct Body {
    block: Block,
}

#[pymethods]
impl Body {
    /// An object from the arguments of `freestand.Block`.
    #[new]
    fn new(values: &Bound<'_, PyDict>) -> PyResult<Self> {
        let mut given = Given::new(values);
        let (height, thickness) = (given.positive("height_m"), given.positive("thickness_m"));
        let mass_kg = given.positive("mass_kg");
        given.positive("width_m");
        let inertia = given.positive("inertia_kg_m2");
        if inertia.is_some() && mass_kg.is_none() {
            given.push(Problem::value(
                "inertia_kg_m2 needs the mass of the object",
                "give mass_kg too",
            ));
        }
        let shape = Shape {
            base_width_m: given.positive("base_width_m"),
            cg_height_m: given.positive("cg_height_m"),
            cg_offset_m: given.number("cg_offset_m"),
            inertia_kg_m2: inertia.zip(mass_kg),
        };
        let impossible = |error: freestand::block::BlockError| {
            Problem::value(error.to_string(), "check the dimensions of the object")
        };
        let block = height
            .zip(thickness)
            .map(|(height, thickness)| shape.block(height, thickness).map_err(impossible));
        let block = block.and_then(|block| given.keep(block));
        let cushion = given.cushion_words();
        given.edge(&cushion, mass_kg);
        given.finish()?;
        let Some(block) = block else {
            let hint = "give height_m and thickness_m";
            return Err(crate::errors::raised(Problem::value(
                "the size of the object is missing",
                hint,
            )));
        };
        Ok(Self { block })
    }

    #[getter]
    fn half_diagonal_m(&self) -> f64 {
        self.block.pivot().half_diagonal_m
    }

    #[getter]
    fn slenderness_angle_rad(&self) -> f64 {
        self.block.pivot().slenderness_angle_rad
    }

    #[getter]
    fn frequency_rad_s(&self) -> f64 {
        self.block.pivot().frequency_parameter_rad_s(G0_M_S2)
    }

    #[getter]
    fn restitution_ratio(&self) -> f64 {
        self.block.landing_ratio()
    }

    #[getter]
    fn lift_acceleration_g(&self) -> f64 {
        freestand::rocking::RockingModel::Rigid.uplift_threshold_ratio(&self.block)
    }
}
