//! Formulas of pictures and of what is read of them, evaluated texel by texel: `srgb(d)`, `n.x, 1 - n.y, n.z`, `1 - r`.
//!
//! The material that most of them are about, 16 x 16 texels: `N` unit normals, y up, and `n` these as (N + 1) / 2; `d` diffuse, `s`
//! specular, `r` roughness. Of any size: column `x`, row `y`, `u` and `v` in [0, 1]; `h` heights of bumps and `hn` their normals as
//! stored. Numbers spread over as many channels as they meet.

use std::iter::Peekable;
use std::str::Chars;

/// The texel that a formula is evaluated for.
#[derive(Clone, Copy)]
pub struct Place {
    pub x: usize,
    pub y: usize,
    pub size: [usize; 2],
}

/// The numbers of a formula, one for each channel.
///
/// # Panics
/// Where it is none.
pub fn values(text: &str, place: Place) -> Vec<f64> {
    let mut formula = Formula { rest: text.chars().peekable(), text, place };
    let values = formula.list();
    assert!(formula.next().is_none(), "what follows `{text}` up to `{}`?", formula.rest.collect::<String>());
    values
}

struct Formula<'a> {
    rest: Peekable<Chars<'a>>,
    text: &'a str,
    place: Place,
}

impl Formula<'_> {
    /// The next character but for spaces.
    fn next(&mut self) -> Option<char> {
        while self.rest.next_if(|c| c.is_whitespace()).is_some() {}
        self.rest.peek().copied()
    }

    fn takes(&mut self, wanted: char) -> bool {
        self.next() == Some(wanted) && self.rest.next().is_some()
    }

    fn list(&mut self) -> Vec<f64> {
        let mut all = self.sum();
        while self.takes(',') {
            all.extend(self.sum());
        }
        all
    }

    fn sum(&mut self) -> Vec<f64> {
        let mut all = self.product();
        loop {
            if self.takes('+') {
                all = both(all, self.product(), |a, b| a + b);
            } else if self.takes('-') {
                all = both(all, self.product(), |a, b| a - b);
            } else {
                return all;
            }
        }
    }

    fn product(&mut self) -> Vec<f64> {
        let mut all = self.factor();
        loop {
            if self.takes('*') {
                all = both(all, self.factor(), |a, b| a * b);
            } else if self.takes('/') {
                all = both(all, self.factor(), |a, b| a / b);
            } else {
                return all;
            }
        }
    }

    fn factor(&mut self) -> Vec<f64> {
        if self.takes('-') {
            return self.factor().into_iter().map(|value| -value).collect();
        }
        let values = if self.takes('(') { self.bracket() } else { self.atom() };
        match self.takes('.') {
            true => {
                let at = self.rest.next().and_then(|name| "xyz".find(name));
                vec![values[at.unwrap_or_else(|| panic!("a component in `{}`", self.text))]]
            }
            false => values,
        }
    }

    /// What is up to the closing bracket.
    fn bracket(&mut self) -> Vec<f64> {
        let values = self.list();
        assert!(self.takes(')'), "a bracket is open in `{}`", self.text);
        values
    }

    fn atom(&mut self) -> Vec<f64> {
        self.next();
        let is_number = self.rest.peek().is_some_and(char::is_ascii_digit);
        let mut word = String::new();
        while let Some(c) = self.rest.next_if(|c| c.is_ascii_alphanumeric() || (is_number && *c == '.')) {
            word.push(c);
        }
        if is_number {
            return vec![word.parse().unwrap_or_else(|_| panic!("the number `{word}` in `{}`", self.text))];
        }
        if self.takes('(') {
            let of = self.bracket();
            return self.function(&word, of);
        }
        let Place { x, y, size } = self.place;
        let share = |at: usize, side: usize| at as f64 / (side.max(2) - 1) as f64;
        match word.as_str() {
            "N" => normal(x, y).into(),
            "n" => normal(x, y).map(stored).into(),
            "d" => vec![0.1 + 0.5 * x as f64 / 16.0, 0.3, 0.2 * y as f64 / 16.0],
            "s" => vec![0.04, 0.04 + 0.1 * x as f64 / 16.0, 0.04],
            "r" => vec![0.2 + 0.6 * y as f64 / 16.0],
            "x" => vec![x as f64],
            "y" => vec![y as f64],
            "u" => vec![share(x, size[0])],
            "v" => vec![share(y, size[1])],
            "h" => vec![height(x, y)],
            "hn" => bumps(x, y).map(stored).into(),
            "nan" => vec![f64::NAN],
            "inf" => vec![f64::INFINITY],
            _ => panic!("`{word}` in `{}` is not known", self.text),
        }
    }

    fn function(&self, name: &str, of: Vec<f64>) -> Vec<f64> {
        let each = |function: &dyn Fn(f64) -> f64| of.iter().map(|value| function(*value)).collect();
        match name {
            "srgb" => each(&|v| if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }),
            "linear" => each(&|v| if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }),
            "gamma" => each(&|v| v.powf(1.0 / 2.2)),
            "sqrt" => each(&f64::sqrt),
            "sin" => each(&f64::sin),
            "cos" => each(&f64::cos),
            "unit" => {
                let length = of.iter().map(|value| value * value).sum::<f64>().sqrt();
                each(&|value| value / length)
            }
            // 1 where the first is less, else 0.
            "less" => vec![f64::from(of[0] < of[1])],
            "is" => vec![f64::from(of[0] == of[1])],
            "if" => vec![if of[0] == 0.0 { of[2] } else { of[1] }],
            "code" => each(&|v| (255.0 * v).round() / 255.0),
            "clamp" => each(&|v| v.clamp(0.0, 1.0)),
            _ => panic!("the function `{name}` in `{}` is not known", self.text),
        }
    }
}

fn both(a: Vec<f64>, b: Vec<f64>, of: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let count = a.len().max(b.len());
    assert!([a.len(), b.len()].iter().all(|len| *len == 1 || *len == count), "{a:?} and {b:?}");
    (0..count).map(|i| of(a[i.min(a.len() - 1)], b[i.min(b.len() - 1)])).collect()
}

fn stored(component: f64) -> f64 {
    0.5 * component + 0.5
}

/// Height is sin(6 u) sin(5 v); v points down, y up.
fn normal(x: usize, y: usize) -> [f64; 3] {
    let [u, v] = [x, y].map(|i| i as f64 / 16.0);
    let slope = [0.5 * (6.0 * u).cos() * (5.0 * v).sin(), -0.5 * (6.0 * u).sin() * (5.0 * v).cos()];
    let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
    [-slope[0] / length, -slope[1] / length, 1.0 / length]
}

/// The side of the bumps of `h`.
const BUMPS: usize = 64;

fn height(x: usize, y: usize) -> f64 {
    let [u, v] = [x, y].map(|i| i as f64 / BUMPS as f64);
    0.5 + 0.2 * (9.0 * u).sin() * (7.0 * v).cos() + 0.1 * (5.0 * u + 11.0 * v).sin()
}

fn bumps(x: usize, y: usize) -> [f64; 3] {
    let at = |x: usize, y: usize| height(x.min(BUMPS - 1), y.min(BUMPS - 1));
    let slope = [
        -4.0 * (at(x + 1, y) - at(x.saturating_sub(1), y)),
        -4.0 * (at(x, y.saturating_sub(1)) - at(x, y + 1)),
    ];
    let length = (slope[0] * slope[0] + slope[1] * slope[1] + 1.0).sqrt();
    [slope[0] / length, slope[1] / length, 1.0 / length]
}
