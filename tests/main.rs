//! Tests across the crates, and of the repository itself, in one binary. Those of one crate are in its own
//! `tests`.

#[cfg(test)]
mod advisories;
#[cfg(test)]
mod allocation;
#[cfg(test)]
mod benchmarks;
#[cfg(test)]
mod binaries;
#[cfg(test)]
mod circles;
#[cfg(test)]
mod comments;
#[cfg(test)]
mod front_pages;
#[cfg(test)]
mod licences;
#[cfg(test)]
mod maps;
#[cfg(test)]
mod names;
#[cfg(test)]
mod packages;
#[cfg(test)]
mod releases;
