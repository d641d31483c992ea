//! The contact of two bodies: arms, crush plane, and the inverse mass at C.

use core::f64::consts::PI;

use nalgebra::Vector2;
use real::Real;

use crate::body::{Body, Motion, Participant};
use crate::check;
use crate::error::InvalidInput;

/// Below this fraction of the distance between the CGs, rounding decides on which side of the crush plane
/// they lie.
const NORMAL_RESOLUTION: f64 = 1e-12;

/// A vector at C in the axes of the crush plane: along its normal n and along t, which is n turned by +90°.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NormalTangential<T = f64> {
    /// Component along n.
    pub normal: T,
    /// Component along t.
    pub tangential: T,
}

impl<T: Real> NormalTangential<T> {
    #[inline(always)]
    fn of(v: Vector2<T>, n: Vector2<T>) -> Self {
        Self { normal: v.x * n.x + v.y * n.y, tangential: v.y * n.x - v.x * n.y }
    }

    /// The scalar cross product: a × b = a_n b_t − a_t b_n.
    #[inline(always)]
    fn cross(self, b: Self) -> T {
        self.normal * b.tangential - self.tangential * b.normal
    }

    /// The same vector in the scene frame, for the normal n.
    #[inline(always)]
    pub(crate) fn in_scene(self, n: Vector2<T>) -> Vector2<T> {
        Vector2::new(self.normal * n.x - self.tangential * n.y, self.normal * n.y + self.tangential * n.x)
    }
}

/// The contact inverse-mass matrix K in n–t axes: U = u + K P. Symmetric and positive definite. A moment
/// impulse at C adds a third row and column.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InverseMass<T = f64> {
    /// (1/kg) k_nn.
    pub nn: T,
    /// (1/kg) k_nt = k_tn.
    pub nt: T,
    /// (1/kg) k_tt.
    pub tt: T,
    /// (1/(kg·m)) k_nm: normal velocity at C due to a unit moment impulse, and relative yaw rate due to a
    /// unit normal impulse.
    pub nm: T,
    /// (1/(kg·m)) k_tm: the same for the tangential direction.
    pub tm: T,
    /// (1/(kg·m²)) k_mm: relative yaw rate due to a unit moment impulse.
    pub mm: T,
}

/// Relative motion of two bodies at C.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approach<T = f64> {
    /// (m/s) u, velocity of vehicle 1 relative to vehicle 2 at C.
    pub velocity: NormalTangential<T>,
    /// (rad/s) ω_1 − ω_2, yaw rate of vehicle 1 relative to vehicle 2.
    pub relative_yaw_rate: T,
}

impl<T: Real> InverseMass<T> {
    #[inline(always)]
    fn new(bodies: [&Body<T>; 2], arms: [NormalTangential<T>; 2]) -> Self {
        let [b1, b2] = bodies;
        let [r1, r2] = arms;
        let (j1, j2) = (b1.inverse_yaw_inertia(), b2.inverse_yaw_inertia());
        let translation = b1.inverse_mass() + b2.inverse_mass();
        // K = (1/m₁ + 1/m₂) 1 + ρ₁ρ₁ᵀ/I₁ + ρ₂ρ₂ᵀ/I₂,  ρᵢ = (−r_it, r_in)
        Self {
            nn: translation + r1.tangential * r1.tangential * j1 + r2.tangential * r2.tangential * j2,
            nt: -(r1.normal * r1.tangential * j1) - r2.normal * r2.tangential * j2,
            tt: translation + r1.normal * r1.normal * j1 + r2.normal * r2.normal * j2,
            // A unit moment impulse gives vehicle 1 the yaw rate 1/I₁ and vehicle 2 −1/I₂; these move C by
            // ρᵢ.
            nm: -(r1.tangential * j1) - r2.tangential * j2,
            tm: r1.normal * j1 + r2.normal * j2,
            mm: j1 + j2,
        }
    }

    /// (1/kg²) det K, always positive.
    #[inline(always)]
    #[must_use]
    pub fn determinant(&self) -> T {
        self.nn * self.tt - self.nt * self.nt
    }

    /// The relative motion at C after the impulse P (N·s) and the moment impulse M (N·m·s).
    #[inline(always)]
    #[must_use]
    pub fn separation(&self, approach: Approach<T>, p: NormalTangential<T>, moment: T) -> Approach<T> {
        Approach {
            velocity: self.separation_velocity(approach.velocity, p, moment),
            // Ω₁ − Ω₂ = ω₁ − ω₂ + k_nm P_n + k_tm P_t + k_mm M
            relative_yaw_rate: approach.relative_yaw_rate
                + self.nm * p.normal
                + self.tm * p.tangential
                + self.mm * moment,
        }
    }

    /// (m/s) the relative velocity at C after the impulses.
    #[inline(always)]
    pub(crate) fn separation_velocity(
        &self,
        u: NormalTangential<T>,
        p: NormalTangential<T>,
        moment: T,
    ) -> NormalTangential<T> {
        // U = u + K P + (k_nm, k_tm) M
        NormalTangential {
            normal: u.normal + self.nn * p.normal + self.nt * p.tangential + self.nm * moment,
            tangential: u.tangential + self.nt * p.normal + self.tt * p.tangential + self.tm * moment,
        }
    }
}

/// The geometry of a collision: two participants, the crush plane between them, and the quantities that
/// depend on nothing else.
///
/// One contact serves all velocities and impact laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<T = f64> {
    pub(crate) participants: [Participant<T>; 2],
    /// Γ as given.
    pub(crate) crush_plane: T,
    /// Whether n is opposite to Γ.
    pub(crate) turned: bool,
    pub(crate) normal: Vector2<T>,
    pub(crate) arms: [NormalTangential<T>; 2],
    pub(crate) inverse_mass: InverseMass<T>,
}

impl<T: Real> Contact<T> {
    /// Two participants that meet at C on a crush plane whose normal has the scene angle Γ = `crush_plane`
    /// (rad). Γ and Γ + π describe the same plane: n always points from vehicle 2 towards vehicle 1, n·(r_2 −
    /// r_1) > 0.
    ///
    /// # Errors
    /// If Γ is not finite, both bodies are fixed, or the normal cannot be oriented.
    #[inline(always)]
    pub fn new(participants: [Participant<T>; 2], crush_plane: T) -> Result<Self, InvalidInput> {
        match Self::new_with_validity(participants, crush_plane) {
            (contact, true) => Ok(contact),
            _ => Err(Self::impossible(&participants, crush_plane)),
        }
    }

    /// Like [`new`](Self::new), but returns a validity flag in place of an error, so that loops over many
    /// samples vectorise.
    #[inline(always)]
    #[must_use]
    pub fn new_with_validity(participants: [Participant<T>; 2], crush_plane: T) -> (Self, bool) {
        let [p1, p2] = &participants;
        let (sin, cos) = crush_plane.sin_cos();
        let n = Vector2::new(cos, sin);
        // From CG 2 to CG 1: r₂ − r₁.
        let between = p2.arm - p1.arm;
        let along = NormalTangential::of(between, n);
        let distance = (between.x * between.x + between.y * between.y).sqrt();
        let is_oriented = along.normal.abs() > distance * NORMAL_RESOLUTION;
        let is_ahead = along.normal > T::ZERO;
        let normal = if is_ahead { n } else { -n };
        let arms = [NormalTangential::of(p1.arm, normal), NormalTangential::of(p2.arm, normal)];
        let inverse_mass = InverseMass::new([&p1.body, &p2.body], arms);
        let both_fixed = p1.body.is_fixed() & p2.body.is_fixed();
        let can_be = is_oriented & !both_fixed & angle(crush_plane).is_ok();
        (Self { participants, crush_plane, turned: !is_ahead, normal, arms, inverse_mass }, can_be)
    }

    /// The reason why there is no contact.
    #[cold]
    fn impossible([p1, p2]: &[Participant<T>; 2], crush_plane: T) -> InvalidInput {
        match angle(crush_plane) {
            Err(error) => error,
            Ok(()) if p1.body.is_fixed() && p2.body.is_fixed() => InvalidInput::BothFixed,
            Ok(()) => InvalidInput::NormalUndefined { crush_plane: crush_plane.value() },
        }
    }

    /// Vehicle 1 and vehicle 2.
    #[inline(always)]
    #[must_use]
    pub fn participants(&self) -> &[Participant<T>; 2] {
        &self.participants
    }

    /// (rad) Γ, the scene angle of a normal of the crush plane, as given to [`new`](Self::new).
    #[inline(always)]
    #[must_use]
    pub fn crush_plane(&self) -> T {
        self.crush_plane
    }

    /// Whether n is opposite to Γ, because the normal at Γ points from vehicle 1 to vehicle 2.
    #[inline(always)]
    #[must_use]
    pub fn is_turned(&self) -> bool {
        self.turned
    }

    /// (rad) the scene angle of n, in (−π, π]: Γ, or Γ + π if it is turned.
    #[must_use]
    pub fn normal_angle(&self) -> T {
        let turn = if self.turned { PI } else { 0.0 };
        real::principal_angle(self.crush_plane + turn)
    }

    /// Unit normal n of the crush plane in the scene frame, oriented from vehicle 2 towards vehicle 1.
    #[inline(always)]
    #[must_use]
    pub fn normal(&self) -> Vector2<T> {
        self.normal
    }

    /// (m) the arms r_1 and r_2 in n–t axes: (d_d, d_c) and (d_b, d_a) of the paper's Eq 2.
    #[must_use]
    pub fn arms(&self) -> [NormalTangential<T>; 2] {
        self.arms
    }

    /// Resolves a scene vector along the axes of the crush plane.
    #[inline(always)]
    #[must_use]
    pub fn resolve(&self, scene: Vector2<T>) -> NormalTangential<T> {
        NormalTangential::of(scene, self.normal)
    }

    /// The contact inverse-mass matrix K.
    #[inline(always)]
    #[must_use]
    pub fn inverse_mass(&self) -> InverseMass<T> {
        self.inverse_mass
    }

    /// Whether the crush plane through C lies between the two CGs: n·r_1 < 0 < n·r_2. If not, one of the
    /// vehicles would be pushed through the plane, and the geometry should be checked. A barrier has no CG
    /// that could be on the wrong side.
    #[must_use]
    pub fn separates_centres(&self) -> bool {
        let [p1, p2] = &self.participants;
        let [r1, r2] = self.arms;
        (p1.body.is_fixed() || r1.normal < T::ZERO) && (p2.body.is_fixed() || r2.normal > T::ZERO)
    }

    /// The approach at C for the given motions.
    #[inline(always)]
    #[must_use]
    pub fn approach(&self, motions: &[Motion<T>; 2]) -> Approach<T> {
        let [m1, m2] = motions;
        let [r1, r2] = self.arms;
        let v = self.resolve(m1.velocity - m2.velocity);
        Approach {
            // u = (v₁ + ω₁×r₁) − (v₂ + ω₂×r₂),  ω×r = ω (−r_t, r_n)
            velocity: NormalTangential {
                normal: v.normal - m1.yaw_rate * r1.tangential + m2.yaw_rate * r2.tangential,
                tangential: v.tangential + m1.yaw_rate * r1.normal - m2.yaw_rate * r2.normal,
            },
            relative_yaw_rate: m1.yaw_rate - m2.yaw_rate,
        }
    }

    /// The motion of both bodies after vehicle 1 received `impulse` (N·s) at C and `moment` (N·m·s), and
    /// vehicle 2 their opposites.
    #[inline(always)]
    pub(crate) fn after(
        &self,
        motions: &[Motion<T>; 2],
        impulse: NormalTangential<T>,
        moment: T,
    ) -> [Motion<T>; 2] {
        let p = impulse.in_scene(self.normal);
        let [m1, m2] = motions;
        let [b1, b2] = [&self.participants[0].body, &self.participants[1].body];
        let [r1, r2] = self.arms;
        [
            // V₁ = v₁ + P/m₁,  Ω₁ = ω₁ + (r₁×P + M)/I₁
            Motion {
                velocity: m1.velocity + p * b1.inverse_mass(),
                yaw_rate: m1.yaw_rate + (r1.cross(impulse) + moment) * b1.inverse_yaw_inertia(),
            },
            // V₂ = v₂ − P/m₂,  Ω₂ = ω₂ − (r₂×P + M)/I₂
            Motion {
                velocity: m2.velocity - p * b2.inverse_mass(),
                yaw_rate: m2.yaw_rate - (r2.cross(impulse) + moment) * b2.inverse_yaw_inertia(),
            },
        ]
    }
}

#[inline(always)]
fn angle<T: Real>(crush_plane: T) -> Result<(), InvalidInput> {
    check::angle("crush plane angle", crush_plane.value())
}
