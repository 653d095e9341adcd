//! A figure as a document, PDF or SVG, in which text is text.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;

use ab_glyph::Font as _;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish as _, Name, Pdf, Rect, Ref, Str, TextStr};
use subsetter::GlyphRemapper;
use svbrdf_core::image::Image;

use super::layout::{Anchor, FILE, FONT, Figure, FigurePicture, MILLIMETRE, PlacedText, Text, glyphs};
use crate::export::encode::{self, Entries, Provenance};
use crate::session;

/// Largest side of a page, in points: other programs open no larger one.
pub(super) const LARGEST: f64 = 14_400.0;

/// Numbers of the objects; pictures follow.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const INFO: Ref = Ref::new(5);
const TYPE0: Ref = Ref::new(6);
const CID: Ref = Ref::new(7);
const DESCRIPTOR: Ref = Ref::new(8);
const FONT_FILE: Ref = Ref::new(9);
const TO_UNICODE: Ref = Ref::new(10);
const PICTURES: i32 = 11;

/// The name of the font: six letters mark a subset.
const FONT_NAME: Name<'_> = Name(b"SVBRDF+Ubuntu-Light");
const SYSTEM: SystemInfo<'_> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

/// The figure as PDF of one page, in which text is text in an embedded subset of the font and pictures are lossless, with the metadata as
/// keywords.
pub(super) fn pdf(figure: &Figure, entries: &Entries) -> io::Result<Vec<u8>> {
    let [width, height] = figure.size.map(|side| side as f32);
    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut page = pdf.page(PAGE);
    page.parent(PAGES).media_box(Rect::new(0.0, 0.0, width, height)).contents(CONTENT);
    let mut resources = page.resources();
    resources.fonts().pair(Name(b"F"), TYPE0);
    let mut objects = resources.x_objects();
    for number in 0..figure.pictures.len() {
        objects.pair(Name(name(number).as_bytes()), reference(number));
    }
    objects.finish();
    resources.finish();
    page.finish();
    for (number, picture) in figure.pictures.iter().enumerate() {
        write_picture(&mut pdf, reference(number), &picture.printed())?;
    }
    let mut used = Used::default();
    pdf.stream(CONTENT, &content(figure, &mut used));
    used.write(&mut pdf)?;
    let (session, keywords): (Vec<_>, Vec<_>) = entries.iter().partition(|(key, _)| *key == session::KEYWORD);
    let keywords: Vec<String> = keywords.iter().map(|(key, text)| format!("{key}: {text}")).collect();
    let mut info = pdf.document_info(INFO);
    info.producer(TextStr(Provenance::SOFTWARE)).keywords(TextStr(&keywords.join("\n")));
    // A string of its own: keywords in other languages are not ASCII.
    for (key, text) in session {
        info.insert(Name(key.as_bytes())).primitive(Str(text.as_bytes()));
    }
    info.finish();
    Ok(pdf.finish())
}

fn name(number: usize) -> String {
    format!("P{number}")
}

fn reference(number: usize) -> Ref {
    Ref::new(PICTURES + number as i32)
}

fn content(figure: &Figure, used: &mut Used) -> Vec<u8> {
    let height = figure.size[1];
    let mut content = Content::new();
    for (number, picture) in figure.pictures.iter().enumerate() {
        let ([x, y], [wide, high]) = (picture.at, picture.size);
        let place = [wide, 0.0, 0.0, high, x, height - y - high].map(|number| number as f32);
        content.save_state().transform(place).x_object(Name(name(number).as_bytes())).restore_state();
    }
    for text in &figure.texts {
        let [r, g, b] = text.style.ink.map(|channel| f32::from(channel) / 255.0);
        let size = text.style.size as f32;
        let place = [text.left(), height - text.at[1]].map(|number| number as f32);
        content.set_fill_rgb(r, g, b).begin_text().set_font(Name(b"F"), size);
        content.set_text_matrix([1.0, 0.0, 0.0, 1.0, place[0], place[1]]);
        let mut shown = content.show_positioned();
        let mut items = shown.items();
        let (mut run, mut end) = (Vec::new(), 0.0);
        for glyph in glyphs(&text.text) {
            let kern = 1000.0 * (end - glyph.x);
            if kern.abs() > 0.5 {
                items.show(Str(&run)).adjust(kern);
                run.clear();
            }
            run.extend(used.code(glyph).to_be_bytes());
            end = glyph.x + glyph.advance;
        }
        items.show(Str(&run));
        items.finish();
        shown.finish();
        content.end_text();
    }
    content.finish().into_vec()
}

/// The glyphs of all texts: each with its character and its advance in ems, by its code.
#[derive(Default)]
struct Used {
    remapper: GlyphRemapper,
    glyphs: BTreeMap<u16, PlacedText>,
}

impl Used {
    fn code(&mut self, glyph: PlacedText) -> u16 {
        let code = self.remapper.remap(glyph.id.0);
        self.glyphs.entry(code).or_insert(glyph);
        code
    }

    fn write(&self, pdf: &mut Pdf) -> io::Result<()> {
        let file = subsetter::subset(FILE, 0, &self.remapper).map_err(io::Error::other)?;
        pdf.stream(FONT_FILE, &file).pair(Name(b"Length1"), file.len() as i32);
        pdf.type0_font(TYPE0)
            .base_font(FONT_NAME)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(CID)
            .to_unicode(TO_UNICODE);
        let mut cid = pdf.cid_font(CID);
        cid.subtype(CidFontType::Type2).base_font(FONT_NAME).system_info(SYSTEM).font_descriptor(DESCRIPTOR);
        cid.cid_to_gid_map_predefined(Name(b"Identity"));
        let mut widths = cid.widths();
        self.glyphs.iter().for_each(|(code, glyph)| {
            widths.consecutive(*code, [1000.0 * glyph.advance]);
        });
        widths.finish();
        cid.finish();
        let metric = |of: fn(&ab_glyph::FontRef<'static>) -> f32| {
            FONT.as_ref().map_or(0.0, |font| 1000.0 * of(font) / font.units_per_em().unwrap_or(1000.0))
        };
        let [ascent, descent] =
            [metric(|font| font.ascent_unscaled()), metric(|font| font.descent_unscaled())];
        pdf.font_descriptor(DESCRIPTOR)
            .name(FONT_NAME)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(-200.0, descent, 1200.0, ascent))
            .italic_angle(0.0)
            .ascent(ascent)
            .descent(descent)
            .cap_height(700.0)
            .stem_v(60.0)
            .font_file2(FONT_FILE);
        let mut characters = UnicodeCmap::new(Name(b"Characters"), SYSTEM);
        self.glyphs.iter().for_each(|(code, glyph)| characters.pair(*code, glyph.character));
        pdf.cmap(TO_UNICODE, &characters.finish());
        Ok(())
    }
}

/// Writes a picture with the compressed data of its PNG, which PDF reads as they are.
fn write_picture(pdf: &mut Pdf, reference: Ref, image: &Image<u8>) -> io::Result<()> {
    let mut file = Vec::new();
    encode::png(&mut file, image, &[])?;
    let data = encode::compressed(&file);
    let [width, height] = [image.width, image.height].map(|side| side as i32);
    let mut object = pdf.image_xobject(reference, &data);
    object.width(width).height(height).bits_per_component(8).filter(Filter::FlateDecode);
    object.color_space().device_rgb();
    object.decode_parms().predictor(pdf_writer::types::Predictor::PngOptimum).colors(3).columns(width);
    Ok(())
}

/// The figure as SVG, in which text is text, in the font of the reader where it has not that of the program, but as wide; with its metadata
/// as a description.
pub(super) fn svg(figure: &Figure, entries: &Entries) -> io::Result<String> {
    let [width, height] = figure.size;
    let [wide, high] = figure.size.map(|side| side / MILLIMETRE);
    let about: String = entries.iter().map(|(key, text)| format!("{key}: {}\n", escaped(text))).collect();
    let mut svg = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="{wide:.3}mm" height="{high:.3}mm" viewBox="0 0 {width:.3} {height:.3}" font-family="Ubuntu, Helvetica, Arial, sans-serif" font-weight="300">
<desc>{about}</desc>
<rect width="100%" height="100%" fill="#fff"/>
"##
    );
    for picture in &figure.pictures {
        let FigurePicture { at: [x, y], size: [width, height], .. } = picture;
        let mut file = Vec::new();
        encode::png(&mut file, &picture.printed(), &[])?;
        let data = BASE64_STANDARD.encode(file);
        let _ = writeln!(
            svg,
            r#"<image x="{x:.3}" y="{y:.3}" width="{width:.3}" height="{height:.3}" preserveAspectRatio="none" href="data:image/png;base64,{data}"/>"#
        );
    }
    for text in figure.texts.iter().filter(|text| !text.text.is_empty()) {
        let Text { at: [x, y], text: words, style } = text;
        let anchor = match style.anchor {
            Anchor::Left => "start",
            Anchor::Middle => "middle",
            Anchor::Right => "end",
        };
        let [r, g, b] = style.ink;
        let _ = writeln!(
            svg,
            r##"<text x="{x:.3}" y="{y:.3}" font-size="{:.3}" text-anchor="{anchor}" textLength="{:.3}" lengthAdjust="spacingAndGlyphs" fill="#{r:02x}{g:02x}{b:02x}">{}</text>"##,
            style.size,
            text.width(),
            escaped(words)
        );
    }
    Ok(svg + "</svg>\n")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
