//! Pairs whose stiffnesses are those of CRASH3's categories.

use evidence::{Collision, DamagedSide, FITTED, Fitted};
use pim_core::VehicleId;
use uncertainty::InvalidDistribution;

use crate::crash::{Crash, PairKind};
use crate::figure::Figure;
use crate::pair::{Pair, PairVehicle, usual_category};

/// A pair with the category of each vehicle that an analyst would choose.
#[derive(Clone, Debug, PartialEq)]
pub struct PairByCategory(Pair);

impl PairByCategory {
    /// Chooses the categories.
    #[must_use]
    pub fn new(mut pair: Pair) -> Self {
        for vehicle in &mut pair.vehicles {
            vehicle.category = Some(usual_category(vehicle.curb_mass));
        }
        Self(pair)
    }

    /// The pair with its categories.
    #[must_use]
    pub fn pair(&self) -> &Pair {
        &self.0
    }

    /// The figures of the field for such a pair.
    #[must_use]
    pub fn fitted(&self) -> Fitted {
        FITTED.by_category(&self.0.vehicles.each_ref().map(|vehicle| DamagedSide::from(vehicle.plane)))
    }
}

impl Crash for PairByCategory {
    const FIGURES: &'static [Figure] = &Figure::OF_CATEGORIES;
    const IS_WITH_OBJECT: bool = Pair::IS_WITH_OBJECT;

    fn case(&self) -> &str {
        self.0.case()
    }

    fn vehicle(&self, id: VehicleId) -> Option<&PairVehicle> {
        self.0.vehicle(id)
    }

    fn kind(&self) -> PairKind {
        self.0.kind()
    }

    fn is_one_event(&self) -> Option<bool> {
        self.0.is_one_event()
    }

    fn known(
        &self,
        crushed: Option<VehicleId>,
        fitted: &Fitted,
        given: &[VehicleId],
    ) -> Result<Collision, InvalidDistribution> {
        self.0.known(crushed, fitted, given)
    }
}
