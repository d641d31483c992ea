//! Random cases over all forms of the keys that enter an impact.

use ::uncertainty::random::{bits, unit};

/// A case, and the forms that it has.
pub(crate) struct AnyCase {
    pub(crate) text: String,
    pub(crate) forms: Vec<&'static str>,
}

/// All forms that there are.
pub(crate) const FORMS: [&str; 41] = [
    "mass",
    "weight",
    "yaw inertia",
    "yaw radius",
    "yaw by class",
    "yaw by Burg",
    "contact by x and y",
    "polar contact",
    "contact placed by outline",
    "contact placed by class",
    "speed",
    "velocity",
    "direction of travel",
    "sideslip",
    "no sideslip",
    "yaw rate",
    "no yaw rate",
    "equal zones",
    "unequal zones",
    "A and B",
    "A, B and G",
    "A, B and a limit",
    "d0 and d1",
    "d0, d1 and G",
    "zones",
    "category",
    "fleet",
    "test",
    "EES",
    "no damage",
    "barrier",
    "fixed with a contact",
    "z-up",
    "z-down",
    "critical",
    "ratio",
    "fraction",
    "friction",
    "Ishikawa",
    "Kudlich and Slibar",
    "Woolley",
];

struct Dice {
    seed: u64,
    thrown: u64,
    /// (–) the standard deviation of a number, as a share of the number.
    share: f64,
    forms: Vec<&'static str>,
}

impl Dice {
    /// From `low` to `high`.
    fn number(&mut self, low: f64, high: f64) -> f64 {
        self.thrown += 1;
        low + (high - low) * unit(bits(self.seed, self.thrown))
    }

    /// One of these forms.
    fn one_of(&mut self, forms: &[&'static str]) -> &'static str {
        self.thrown += 1;
        let place = bits(self.seed, self.thrown) % u64::try_from(forms.len()).unwrap();
        let form = forms[usize::try_from(place).unwrap()];
        self.forms.push(form);
        form
    }

    /// A number with a range.
    fn range(&mut self, low: f64, high: f64, of: &str) -> String {
        let value = self.number(low, high);
        let sd = self.share * value.abs() + 1e-3;
        if of.is_empty() {
            format!("{{ value = {value}, sd = {sd} }}")
        } else {
            format!("{{ value = \"{value} {of}\", sd = \"{sd} {of}\" }}")
        }
    }

    fn line(&mut self, form: &str) -> String {
        let a_b = |dice: &mut Self| {
            format!("A = {}, B = {}", dice.range(3e4, 6e4, "N/m"), dice.range(4e5, 9e5, "N/m^2"))
        };
        let d0_d1 = |dice: &mut Self| {
            format!("d0 = {}, d1 = {}", dice.range(60.0, 90.0, "N^0.5"), dice.range(600.0, 900.0, "N^0.5/m"))
        };
        match form {
            "A and B" => a_b(self),
            "A, B and G" => format!("{}, G = {}", a_b(self), self.range(1e3, 4e3, "N")),
            "A, B and a limit" => format!("{}, limit = {}", a_b(self), self.range(1e5, 3e5, "N/m")),
            "d0 and d1" => d0_d1(self),
            _ => format!("{}, G = {}", d0_d1(self), self.range(1e3, 4e3, "N")),
        }
    }

    /// The table of a measured crush, on a side of a vehicle; `offset` where the contact is placed.
    fn crush(&mut self, side: &str, is_placed: bool) -> String {
        const LINES: [&str; 5] = ["A and B", "A, B and G", "A, B and a limit", "d0 and d1", "d0, d1 and G"];
        let depths: Vec<String> = (0..5).map(|_| format!("{}", self.number(10.0, 40.0))).collect();
        let depths =
            format!("{{ values = \"{} cm\", sd = \"{} cm\" }}", depths.join(" "), 1.0 + 20.0 * self.share);
        let width = match self.one_of(&["equal zones", "unequal zones"]) {
            "equal zones" => format!("width = {}", self.range(1.2, 1.6, "m")),
            _ => format!(
                "spacing = {{ values = \"30 35 40 30 cm\", sd = \"{} cm\" }}",
                1.0 + 20.0 * self.share
            ),
        };
        let form = self.one_of(&["line", "zones", "category", "fleet", "test"]);
        let stiffness = match form {
            "line" => {
                let form = self.one_of(&LINES);
                self.line(form)
            }
            "zones" => {
                let lines: Vec<String> = (0..4)
                    .map(|_| {
                        let form = self.one_of(&LINES);
                        format!("{{ {} }}", self.line(form))
                    })
                    .collect();
                format!("zones = [{}]", lines.join(", "))
            }
            "category" => "category = 3".to_owned(),
            _ => format!(
                "test = {{ mass = {}, speed = \"56 km/h\", width = {}, depths = \"42 50 54 54 50 42 cm\", \
                 no_damage_speed = {} }}",
                self.range(1400.0, 1700.0, "kg"),
                self.range(1.5, 1.7, "m"),
                self.range(6.0, 14.0, "km/h"),
            ),
        };
        let offset =
            if is_placed { format!("offset = {}\n", self.range(-0.2, 0.2, "m")) } else { String::new() };
        let stiffness = if form == "fleet" { "\"fleet\"".to_owned() } else { format!("{{ {stiffness} }}") };
        format!("side = \"{side}\"\n{width}\ndepths = {depths}\nstiffness = {stiffness}\n{offset}")
    }

    /// A vehicle that moves.
    fn vehicle(&mut self, number: u8) -> String {
        let (side, heading) = if number == 1 { ("front", 0.0) } else { ("left", 90.0) };
        let mut lines = match self.one_of(&["mass", "weight"]) {
            "mass" => format!("mass = {}\n", self.range(1200.0, 1700.0, "kg")),
            _ => format!("weight = {}\n", self.range(2700.0, 3700.0, "lb")),
        };
        lines += &format!("heading = {}\n", self.range(heading - 15.0, heading + 15.0, "deg"));
        let damage = self.one_of(&["measured", "measured", "EES", "no damage"]);
        let mut contacts = vec!["contact by x and y", "polar contact"];
        if damage == "measured" {
            contacts.extend(["contact placed by outline", "contact placed by class"]);
        }
        let contact = self.one_of(&contacts);
        // Burg's formula takes the length of the outline.
        let mut yaws = vec!["yaw inertia", "yaw radius", "yaw by class"];
        if contact != "contact placed by class" {
            yaws.push("yaw by Burg");
        }
        let yaw = self.one_of(&yaws);
        let has_class = yaw == "yaw by class" || contact == "contact placed by class";
        if has_class {
            lines += "class = 3\n";
        }
        match yaw {
            "yaw inertia" => lines += &format!("yaw_inertia = {}\n", self.range(2000.0, 3000.0, "kg m^2")),
            "yaw radius" => lines += &format!("yaw_radius = {}\n", self.range(1.2, 1.5, "m")),
            "yaw by Burg" => lines += &format!("wheelbase = {}\n", self.range(2.4, 2.8, "m")),
            _ => {}
        }
        if contact == "contact placed by outline" {
            let [length, width, front] =
                [self.range(4.2, 4.6, "m"), self.range(1.7, 1.8, "m"), self.range(1.9, 2.2, "m")];
            lines += &format!("length = {length}\nwidth = {width}\ncg_to_front = {front}\n");
        } else if yaw == "yaw by Burg" {
            lines += &format!("length = {}\n", self.range(4.2, 4.6, "m"));
        }
        let [ahead, aside] = if number == 1 { [1.9, 0.0] } else { [0.2, 0.8] };
        match contact {
            "contact by x and y" => {
                let [x, y] = [ahead, aside].map(|at| self.range(at - 0.2, at + 0.2, "m"));
                lines += &format!("contact = {{ x = {x}, y = {y} }}\n");
            }
            "polar contact" => {
                let [distance, angle] = if number == 1 { [1.9, 0.0] } else { [0.9, 80.0] };
                let distance = self.range(distance - 0.2, distance + 0.2, "m");
                let angle = self.range(angle - 10.0, angle + 10.0, "deg");
                lines += &format!("contact = {{ distance = {distance}, angle = {angle} }}\n");
            }
            _ => {}
        }
        if self.one_of(&["yaw rate", "no yaw rate"]) == "yaw rate" {
            lines += &format!("yaw_rate = {}\n", self.range(-20.0, 20.0, "deg/s"));
        }
        let sideslip = self.one_of(&["sideslip", "no sideslip", "no sideslip", "no sideslip"]);
        if sideslip == "sideslip" {
            lines += &format!("sideslip = {}\n", self.range(-10.0, 10.0, "deg"));
        }
        // A velocity has its own direction, even that of a vehicle whose speed is sought.
        let mut motions = if number == 1 { vec!["heading", "heading"] } else { vec!["speed"] };
        if sideslip == "no sideslip" {
            motions.push(if number == 1 { "direction of travel" } else { "velocity" });
        }
        match self.one_of(&motions) {
            "speed" => lines += &format!("speed = {}\n", self.range(2.0, 9.0, "m/s")),
            "velocity" => {
                let [x, y] = [self.range(-1.0, 1.0, "m/s"), self.range(2.0, 9.0, "m/s")];
                lines += &format!("velocity = {{ x = {x}, y = {y} }}\n");
            }
            "direction of travel" => lines += "velocity = { x = \"9 m/s\", y = \"1 m/s\" }\n",
            _ => {}
        }
        let crush = match damage {
            "measured" => self.crush(side, contact.starts_with("contact placed")),
            "EES" => format!("ees = {}\n", self.range(6.0, 12.0, "m/s")),
            _ => return format!("[vehicle{number}]\n{lines}crush = \"none\"\n"),
        };
        format!("[vehicle{number}]\n{lines}[vehicle{number}.crush]\n{crush}")
    }

    fn impact(&mut self) -> String {
        let e = self.range(0.05, 0.3, "");
        let brach = |tangential: String| format!("restitution = {e}\ntangential = {tangential}\n");
        let law = match self.one_of(&[
            "critical",
            "ratio",
            "fraction",
            "friction",
            "Ishikawa",
            "Kudlich and Slibar",
            "Woolley",
        ]) {
            "critical" => brach("\"critical\"".to_owned()),
            "ratio" => brach(format!("{{ ratio = {} }}", self.range(-0.2, 0.2, ""))),
            "fraction" => brach(format!("{{ fraction = {} }}", self.range(0.5, 0.9, ""))),
            "friction" => brach(format!("{{ friction = {} }}", self.range(0.3, 0.6, ""))),
            "Ishikawa" => format!(
                "law = \"ishikawa\"\nrestitution = {e}\ntangential_restitution = {}\n",
                self.range(0.0, 0.2, "")
            ),
            "Kudlich and Slibar" => format!(
                "law = \"kudlich-slibar\"\nrestitution = {e}\nfriction = {}\n",
                self.range(0.3, 0.6, "")
            ),
            _ => "law = \"woolley\"\n".to_owned(),
        };
        format!("[impact]\ncrush_plane = {}\n{law}", self.range(170.0, 190.0, "deg"))
    }
}

/// A car that runs into the left side of another, or into a fixed object, and whose speed is sought. There
/// may be no such speed.
pub(crate) fn any_case(seed: u64) -> AnyCase {
    let mut dice = Dice { seed, thrown: 0, share: 0.02, forms: Vec::new() };
    // In some cases the spread is so wide that many samples are refused.
    dice.share = if dice.number(0.0, 1.0) < 0.3 { 0.4 } else { 0.02 };
    let axes = dice.one_of(&["z-up", "z-down"]);
    let first = dice.vehicle(1);
    let second = match dice.one_of(&["moves", "moves", "moves", "moves", "barrier", "fixed with a contact"]) {
        "barrier" => "[vehicle2]\nfixed = true\n".to_owned(),
        "fixed with a contact" => {
            let [x, y] = [dice.range(-0.2, 0.2, "m"), dice.range(0.8, 1.2, "m")];
            let heading = dice.range(80.0, 100.0, "deg");
            format!("[vehicle2]\nfixed = true\nheading = {heading}\ncontact = {{ x = {x}, y = {y} }}\n")
        }
        _ => dice.vehicle(2),
    };
    let impact = dice.impact();
    let text = format!(
        "[scene]\naxes = \"{axes}\"\n{first}{second}{impact}[reconstruct]\nfind = \"vehicle1.speed\"\n"
    );
    AnyCase { text, forms: dice.forms }
}
