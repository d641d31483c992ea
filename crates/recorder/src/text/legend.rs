//! What a heading says about its numbers: `Brake (0 = On, 1 = Off)`, `Delta-V (left positive)`.

use super::heads::Head;
use super::tokens::{OFF, ON, Token, bare, number};
use crate::channel::{Channel, is_one_of};
use crate::table::{TextFault, TextRefusal};

/// Words for the side of zero on which a direction is.
const POSITIVE: &str = "positive, pos, +";
const NEGATIVE: &str = "negative, neg, -";
/// Words for a direction along the vehicle, and across it.
const FORWARD: &str = "forward, forwards";
const REARWARD: &str = "deceleration, decel, decelerating, braking, rearward, rearwards, backward, backwards";
const RIGHT: &str = "right, rightward, rightwards, rechts";
const LEFT: &str = "left, leftward, leftwards, links";

/// How the numbers of a column are meant.
pub(super) struct Legend {
    /// The numbers of a switch, and whether it is on.
    states: Vec<(f64, bool)>,
    /// 1, or −1 if the numbers are positive to the rear or to the left.
    sign: f64,
}

/// The words of a heading in lower case, and the signs before, after and between them.
fn words(text: &str) -> Vec<String> {
    let text = text.to_lowercase().replace('−', "-");
    let mut found = Vec::new();
    for token in text.split(|letter: char| letter.is_whitespace() || "()[],;:=/".contains(letter)) {
        let inner = token.trim_matches(['+', '-']);
        let (before, after) = token.split_once(inner).unwrap_or((token, ""));
        let words = inner.split(|letter: char| !letter.is_alphabetic());
        found.extend([before].into_iter().chain(words).chain([after]).map(str::to_owned));
    }
    found
}

impl Legend {
    /// That of a heading.
    pub(super) fn of(head: &Head) -> Result<Self, TextRefusal> {
        let (along, across) = ((FORWARD, REARWARD), (RIGHT, LEFT));
        let plain = Self { states: Vec::new(), sign: 1.0 };
        let directions = match head.channel {
            channel if channel.is_switch() => return Ok(Self { states: states(head)?, ..plain }),
            Channel::DeltaVLongitudinal | Channel::AccelerationLongitudinal => along,
            Channel::DeltaVLateral | Channel::AccelerationLateral => across,
            _ => return Ok(plain),
        };
        let said = |word: &String| {
            let [side, direction] = [(POSITIVE, NEGATIVE), directions].map(|(more, less)| {
                is_one_of(more, word).then_some(1.0).or_else(|| is_one_of(less, word).then_some(-1.0))
            });
            side.map(|sign| (true, sign)).or(direction.map(|sign| (false, sign)))
        };
        let said: Vec<(bool, f64)> = words(&head.text).iter().filter_map(said).collect();
        let has = |is_side: bool| said.iter().any(|(side, _)| *side == is_side);
        if !has(true) || !has(false) {
            return Ok(plain);
        }
        let pairs: Vec<f64> =
            said.chunks(2).map(|pair| pair.iter().map(|(_, sign)| sign).product()).collect();
        let is_paired = said.chunks(2).all(|pair| matches!(pair, [one, other] if one.0 != other.0));
        if !is_paired || pairs.iter().any(|sign| *sign != pairs[0]) {
            return Err(unclear(head));
        }
        Ok(Self { sign: pairs[0], ..plain })
    }

    /// The value of a cell of a switch by this legend; `None` if it says nothing of it.
    pub(super) fn state(&self, cell: &Token) -> Option<Option<bool>> {
        let printed = number(bare(&cell.text), false).filter(|_| !self.states.is_empty())?;
        Some(self.states.iter().find(|(number, _)| *number == printed).map(|(_, on)| *on))
    }

    /// A value (SI) with the sign of this program: positive forward, and to the right.
    pub(super) fn signed(&self, value: f64) -> f64 {
        if value == 0.0 { value } else { self.sign * value }
    }
}

fn unclear(head: &Head) -> TextRefusal {
    let instead = if head.channel.is_switch() {
        "write on and off for its values"
    } else {
        "write the values positive forward and to the right, and leave out what the heading says of the sign"
    };
    TextFault::Legend { heading: head.text.clone(), instead }.at(head.place)
}

/// The numbers that a heading gives the states of a switch: `0 = On`, `On: 0`.
fn states(head: &Head) -> Result<Vec<(f64, bool)>, TextRefusal> {
    let text = head.text.to_lowercase();
    let mut found: Vec<(f64, bool)> = Vec::new();
    let mut is_said = false;
    for part in text.split([',', ';', '(', ')', '[', ']', '/']) {
        // "0 = off 1 = on": each sign of equality has its number next to it.
        let words: Vec<&str> = part.split(['=', ':', ' ']).filter(|word| !word.is_empty()).collect();
        let numbers: Vec<usize> = (0..words.len()).filter(|at| number(words[*at], false).is_some()).collect();
        let (Some(first), true) = (numbers.first(), part.contains(['=', ':'])) else { continue };
        is_said = true;
        let leads = *first == 0;
        for (k, at) in numbers.iter().enumerate() {
            let own = if leads {
                at + 1..numbers.get(k + 1).copied().unwrap_or(words.len())
            } else {
                k.checked_sub(1).map_or(0, |before| numbers[before] + 1)..*at
            };
            let state = words[own].join(" ");
            let on =
                is_one_of(OFF, &state).then_some(false).or_else(|| is_one_of(ON, &state).then_some(true));
            if let (Some(printed), Some(on)) = (number(words[*at], false), on) {
                found.push((printed, on));
            }
        }
    }
    // "0 = On" alone says that 1 is off.
    if let [(printed, on)] = found.as_slice()
        && [0.0, 1.0].contains(printed)
    {
        found.push((1.0 - printed, !on));
    }
    let [ons, offs] = [true, false].map(|on| found.iter().filter(|state| state.1 == on).count());
    let twice = found.iter().any(|(one, on)| found.iter().any(|(other, off)| one == other && on != off));
    if is_said && (ons == 0 || offs == 0 || twice) {
        return Err(unclear(head));
    }
    Ok(found)
}
