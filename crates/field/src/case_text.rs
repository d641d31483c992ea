//! The case file of a pair.

use std::f64::consts::PI;

use evidence::{Behind, DamagedSide, Fitted};
use pim_core::VehicleId;
use real::Real;

use crate::collision::{Layout, TO_FRONT};
use crate::pair::{Pair, Plane};

/// A number with its unit, or a range if its error is above zero.
fn number(value: f64, sd: f64, decimals: usize, unit: &str) -> String {
    // Zero without a sign.
    let shown = |value: f64| {
        let digits = format!("{value:.decimals$}");
        let digits =
            if digits.trim_matches(['-', '0', '.']).is_empty() { digits.replace('-', "") } else { digits };
        format!("\"{digits} {unit}\"")
    };
    if sd > 0.0 { format!("{{ value = {}, sd = {} }}", shown(value), shown(sd)) } else { shown(value) }
}

fn angle(radians: f64, sd: f64) -> String {
    number(real::principal_angle(radians).to_degrees(), sd.to_degrees(), 2, "deg")
}

fn side(plane: Plane) -> &'static str {
    match plane {
        Plane::Front => "front",
        Plane::Rear => "rear",
        Plane::Left => "left",
        Plane::Right => "right",
    }
}

/// (√N, √N/m) d₀ and d₁ of a kind of damage: E = ½ ∫ (d₀ + d₁ C)² dl.
fn roots(fitted: &Fitted, damage: DamagedSide) -> [f64; 2] {
    let of_a_metre = fitted.crush_of(damage, 1.0, 1.0, 1.0);
    // G = ½ d₀², B = d₁²
    [of_a_metre.constant, of_a_metre.square].map(|energy| Real::sqrt(2.0 * energy))
}

/// (–) the misfit of the crush energy with the errors of the figures behind it, for vehicles as stiff as most
/// of their kind.
fn whole_misfit(layout: &Layout, fitted: &Fitted) -> f64 {
    let hit = layout.damages;
    let misfit = fitted.crush_misfit(&hit).ln_sd;
    let crushes = [0, 1].map(|i| {
        let [mean, mean_square] = layout.shapes[i].depths;
        fitted.crush_of(hit[i], layout.widths[i], mean, mean_square)
    });
    let usual = [1.0; 2];
    let energies = crushes.map(|crush| crush.energy(usual));
    let whole = energies.iter().sum::<f64>();
    match fitted.crush_figures(&hit, hit.map(Behind::Stiffness)) {
        Some(figures) if whole > 0.0 => {
            let of_figures = figures.ln_sd(energies[1] / whole, &crushes.map(|crush| crush.change(usual)));
            Real::sqrt(misfit * misfit + of_figures * of_figures)
        }
        _ => misfit,
    }
}

impl Pair {
    /// The case file of the pair with both speeds unknown, for `deltav estimate`. Its data are those of
    /// [`Pair::collision`], each number with its error. Only the recorders of the vehicles `given` are
    /// evidence.
    ///
    /// Three differences move an interval by a few percent of its width: errors are normal where the
    /// collision has lognormal ones; a number without an error has the small one that an estimate assumes for
    /// it; and numbers are rounded.
    #[must_use]
    pub fn case_text(&self, fitted: &Fitted, given: &[VehicleId]) -> String {
        let layout = Layout::of(self, fitted);
        let mut lines = vec![
            "# Both speeds are unknown; north is along x. Lengths, widths and radii of gyration follow from the".to_owned(),
            "# mass, stiffnesses are those of the fleet by the side that was hit.".to_owned(),
        ];
        for id in VehicleId::ALL {
            let i = id.index();
            let (vehicle, shape) = (&self.vehicles[i], &layout.shapes[i]);
            let ([length, width], [ahead, left]) = (shape.outline, shape.contact);
            let along = |is_free: bool| if is_free { fitted.contact_sd } else { 0.0 };
            let is_side = vehicle.plane.is_side();
            let [d0, d1] = roots(fitted, layout.damages[i]);
            let depths = vehicle.depths.map(|depth| format!("{}", (1e4 * depth).round() / 1e2)).join(" ");
            lines.extend([
                String::new(),
                format!("[vehicle{}]", i + 1),
                format!("mass = {}", number(shape.mass, shape.mass * fitted.mass_ln_sd, 1, "kg")),
                format!("yaw_radius = {}", number(shape.yaw_radius, 0.0, 3, "m")),
                format!("length = {}", number(length, 0.0, 3, "m")),
                format!("width = {}", number(width, 0.0, 3, "m")),
                format!("cg_to_front = {}", number(TO_FRONT * length, 0.0, 3, "m")),
                format!("heading = {}", angle(layout.headings[i], layout.heading_sds[i])),
                format!(
                    "contact = {{ x = {}, y = {} }}",
                    number(ahead, along(is_side), 3, "m"),
                    number(left, along(!is_side), 3, "m"),
                ),
                String::new(),
                format!("[vehicle{}.crush]", i + 1),
                format!("side = \"{}\"", side(vehicle.plane)),
                format!("width = {}", number(layout.widths[i], 0.0, 3, "m")),
                format!("depths = \"{depths} cm\""),
                format!("pdof = {}", number(vehicle.pdof.rem_euclid(2.0 * PI).to_degrees(), 0.0, 0, "deg")),
                // The energy of the whole damage, which the misfit was fitted to.
                "oblique = \"none\"".to_owned(),
                format!("[vehicle{}.crush.stiffness]", i + 1),
                format!("d0 = {}", number(d0, d0 * fitted.no_damage_speed_ln_sd, 2, "N^0.5")),
                format!("d1 = {}", number(d1, d1 * fitted.slope_ln_sd, 2, "N^0.5/m")),
            ]);
            if let Some(truth) = vehicle.truth().filter(|_| given.contains(&id)) {
                lines.extend([String::new(), format!("[vehicle{}.recorder]", i + 1)]);
                let [along, across] = vehicle.recorder;
                // To the left, in the axes of the file.
                let left = across.filter(|_| !truth.is_longitudinal).map(|right| -right);
                let parts = [("longitudinal", along), ("lateral", left)];
                lines.extend(parts.into_iter().filter_map(|(part, stored)| {
                    Some(format!("delta_v_{part} = {}", number(3.6 * stored?, 0.0, 3, "km/h")))
                }));
                lines.push(format!("delta_v_error = \"{:.1} %\"", 100.0 * fitted.recorder_ln_scale));
            }
        }
        lines.extend([
            String::new(),
            "[impact]".to_owned(),
            format!("crush_plane = {}", angle(layout.crush_plane, layout.crush_plane_sd)),
            "# An estimate takes neither as certain: it assumes what is usual in such collisions.".to_owned(),
            "restitution = 0.1".to_owned(),
            "tangential = \"critical\"".to_owned(),
            String::new(),
            "[estimate]".to_owned(),
            // The case file cannot give errors of figures, so these are part of the misfit.
            format!("crush_error = \"{:.1} %\"", 100.0 * whole_misfit(&layout, fitted)),
            format!("crush_bias = \"{:.1} %\"", 100.0 * fitted.crush_misfit(&layout.damages).shown()),
            "stood = \"0 %\"".to_owned(),
            String::new(),
        ]);
        lines.join("\n")
    }
}
