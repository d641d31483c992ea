//! Reading of types with an invariant.

/// Reads a type with an invariant from these fields. An expression checks them and may fail with this error,
/// so that the type itself does not depend on how it is read. The type has one parameter, `T: Real`.
#[doc(hidden)]
#[macro_export]
macro_rules! read_as {
    ($error:ty; $type:ident { $($field:ident: $kind:ty),* $(,)? } => $read:expr) => {
        impl<'de, T: $crate::Real + ::serde::Deserialize<'de>> ::serde::Deserialize<'de> for $type<T> {
            fn deserialize<D: ::serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(::serde::Deserialize)]
                #[serde(bound(deserialize = "T: ::real::Real + ::serde::Deserialize<'de>"))]
                struct $type<T> {
                    $($field: $kind,)*
                }
                let $type { $($field),* } = <$type<T> as ::serde::Deserialize>::deserialize(deserializer)?;
                let read = || -> Result<Self, $error> { $read };
                read().map_err(<D::Error as ::serde::de::Error>::custom)
            }
        }
    };
}
