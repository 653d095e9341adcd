//! Surfaces of MaterialX (`standard_surface`, `gltf_pbr`, `open_pbr_surface` and `UsdPreviewSurface`): maps out of the pictures and
//! values of their inputs.

mod document;
mod graph;
mod input;
mod placement;
mod surface_model;

use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::read::options::{Albedo, NormalEncoding, NormalY, ReadOptions, Role};
use crate::read::record::{Assumption, Certainty, Note, Reason, What};
use crate::read::stored::{
    Field, Inferred, MapsByRole, StoredMap, StoredMaterial, decoded, notice, reflectance, separated,
};

pub(in crate::read) use document::Mtlx;
use graph::Bound;
use input::MtlxSurface;
use surface_model::{SurfaceModel, USD_SPECULAR, USE_SPECULAR};

/// The reflectance of a dielectric of the default refractive index 1.5.
const DEFAULT: f32 = 0.04;

impl Mtlx {
    /// Reads its maps; each picture is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where an input is computed by other nodes; those of its pictures.
    pub(in crate::read) fn read(
        self,
        options: &ReadOptions,
        progress: &Progress,
    ) -> Result<StoredMaterial, Error> {
        let pictures = decoded(&self.pictures, progress)?;
        let mut maps = MapsByRole::default();
        let mut surface = MtlxSurface { located: &self, pictures: &pictures, colours: Vec::new() };
        let albedo = surface.add_to(&mut maps)?;
        let mut found = maps.material(&self.path, self.name.clone(), "", options)?;
        found.add_file(self.path.clone());
        // The pictures of computed maps, too: no output may replace them.
        pictures.iter().for_each(|picture| found.add_file(picture.map.file.clone()));
        found.is_mapped = true;
        found.inferred.specular = albedo.clone();
        found.inferred.albedo = albedo;
        let why = || Reason::stated("MaterialX defines normals in this way");
        found.inferred.normal_y = Some((NormalY::Up, why(), Certainty::Likely));
        found.inferred.normal_encoding = Some((NormalEncoding::Unsigned, why(), Certainty::Likely));
        let layout = Assumption::new(What::Layout, "MaterialX", Reason::LISTED, Certainty::Sure);
        found.assumptions.insert(0, layout);
        found.notes.extend(surface.clipped());
        found.note_document(self.not_modelled.clone(), self.surfaces.clone());
        notice(&mut found, &pictures, |_| true);
        Ok(found)
    }
}

impl MtlxSurface<'_> {
    /// Adds the maps of the inputs to `maps`; returns the encoding of their colours, where the document declares it.
    fn add_to(&mut self, maps: &mut MapsByRole) -> Result<Inferred<Albedo>, Error> {
        let model = self.located.model;
        let SurfaceModel { base, metallic, roughness, normal, .. } = *model;
        if let Some(normal) = self.load(normal, Role::Normal)? {
            maps.add(Role::Normal, normal.source);
        }
        maps.add(Role::Roughness, self.input_or_default(roughness, Role::Roughness)?.source);
        let metallic = self.input_or_default(metallic, Role::Metallic)?;
        let base = self.input_or_default(base, Role::Base)?;
        self.bound(USE_SPECULAR)?;
        if self.located.is_specular_usd() {
            let specular = self.input_or_default(USD_SPECULAR, Role::Specular)?;
            maps.add(Role::Diffuse, self.computed(base.colours(), "diffuseColor"));
            maps.add(Role::Specular, self.computed(specular.colours(), "specularColor"));
            self.colours.extend([base, specular]);
            return Ok(self.linear());
        }
        let dielectric = self.dielectric()?;
        let weight = self.weight(model.weight, 1.0)?;
        let transmission = self.weight(model.transmission, 0.0)?;
        if dielectric.is(DEFAULT) && weight.is(1.0) && transmission.is(0.0) {
            let encoding = base.encoding.clone();
            maps.add(Role::Metallic, metallic.source);
            maps.add(Role::Base, base.source.clone());
            self.colours.push(base);
            return Ok(encoding);
        }
        let [diffuse, specular] = separated(base.colours().times(weight), metallic.numbers(), dielectric);
        self.colours.push(base);
        let diffuse = if transmission.is(0.0) { diffuse } else { diffuse.times(transmission.complement()) };
        maps.add(Role::Diffuse, self.computed(diffuse, "base colour and metallic"));
        maps.add(Role::Specular, self.computed(specular, "specular, its colour and index of refraction"));
        Ok(self.linear())
    }

    /// A number of the surface; `usual` of a model without it.
    fn weight(&self, input: Option<(&'static str, f32)>, usual: f32) -> Result<Field, Error> {
        let Some(input) = input else { return Ok(Field::constant(&[usual])) };
        Ok(self.input_or_default(input, Role::Base)?.numbers())
    }

    fn computed(&self, field: Field, part: &str) -> StoredMap {
        field.into_map(&self.located.path, part)
    }

    /// The encoding of colours that are computed; unsure where that of one of them is.
    fn linear(&self) -> Inferred<Albedo> {
        let doubtful = self.colours.iter().find(|colour| colour.is_doubtful());
        let why = || Reason::stated("computed as the specification of the surface defines it");
        let known = || Some((Albedo::Linear, why(), Certainty::Sure));
        doubtful.and_then(|colour| colour.encoding.clone()).or_else(known)
    }

    /// The colour spaces some of whose colours Rec. 709 does not have.
    fn clipped(&self) -> Option<Note> {
        let mut spaces: Vec<_> = self.colours.iter().filter_map(|colour| colour.clipped.clone()).collect();
        spaces.sort();
        spaces.dedup();
        let spaces = Some(spaces.join(", ")).filter(|spaces| !spaces.is_empty())?;
        let what = "Rec. 709 does not have some of the colours in";
        Some(Note::Changed(format!("{what} {spaces}; they are clipped to [0, 1].")))
    }

    /// The reflectance of the dielectric at normal incidence.
    fn dielectric(&mut self) -> Result<Field, Error> {
        let (name, usual) = self.located.model.ior;
        let ior = match self.bound(name)? {
            Some(Bound::Values { values, .. }) => values.first().copied().unwrap_or(usual),
            Some(Bound::Picture(_)) => {
                return Err(self.refused(name, "a value", "a picture".to_owned()));
            }
            None => usual,
        };
        let mut product = Field::constant(&[reflectance(ior)]);
        for &factor in self.located.model.specular {
            let factor = self.input_or_default(factor, Role::Specular)?;
            product = product.times(factor.factor());
            self.colours.push(factor);
        }
        Ok(product)
    }
}
