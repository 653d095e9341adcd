//! Values that shells complete, of options that take other values, too.

use std::error::Error;
use std::ffi::OsStr;

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command};

/// A parser, and the names that completions offer.
#[derive(Clone)]
struct Offered<P> {
    parser: P,
    names: Vec<String>,
}

/// The parser `parse` of an option, of which completions offer `names`. Where none of them matches, shells offer files.
pub fn offered<T, E>(
    parse: fn(&str) -> Result<T, E>,
    names: impl IntoIterator<Item = impl ToString>,
) -> impl TypedValueParser<Value = T>
where
    T: Clone + Send + Sync + 'static,
    E: Into<Box<dyn Error + Send + Sync>> + 'static,
{
    Offered { parser: parse, names: names.into_iter().map(|name| name.to_string()).collect() }
}

impl<P: TypedValueParser> TypedValueParser for Offered<P> {
    type Value = P::Value;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Self::Value, clap::Error> {
        self.parser.parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.names.iter().map(PossibleValue::new)))
    }
}
