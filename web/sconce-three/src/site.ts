// SPDX-License-Identifier: Apache-2.0
// sconce.json, as `sconce export --web` writes it (docs/web.md).

export type Rgb = [number, number, number];

/** A file of the site. */
export interface SiteFile {
  file: string;
  bytes: number;
}

export interface LightGroup {
  name: string;
  /** Luminous flux at weight 1; 0 for sky and sun. */
  lumens: number;
  /** Linear Rec. 709, luminance 1. */
  color: Rgb;
  /** Sky or sun: has no lumens. */
  infinite: boolean;
  meanLux: number;
  lamps: string[];
}

export interface SiteCamera {
  name: string;
  /** To the world, columns; looks along -z. */
  matrix: number[];
  /** Vertical, radians. */
  yfov: number;
  aspect: number;
}

/** A mood. Empty texts say nothing. */
export interface SitePreset {
  name: string;
  /** `GROUP=SETTING`. */
  settings: string[];
  others: string;
  exposure: string;
  ev100: string;
  tone: string;
  camera: string;
}

export interface SiteMaterial {
  name: string;
  baseColor: Rgb;
  alpha: number;
  alphaCutoff: number;
  metallic: number;
  emission: Rgb;
  doubleSided: boolean;
  /** Its alpha mixes it with what is behind. */
  blends: boolean;
  /** Share of the light on it that goes straight through, in its colour. */
  transmission: number;
  baseMap: number;
  metallicMap: number;
  emissionMap: number;
  normalMap: number;
  normalScale: number;
}

export interface SiteTexture extends Partial<SiteFile> {
  wrap?: [string, string];
  nearest?: boolean;
}

export interface SiteSky extends SiteFile {
  width: number;
  height: number;
  group: number;
  scale: Rgb;
  axes: number[];
}

/** docs/package-format.md, "Planes and probes". */
export interface SiteProbes {
  origin: Rgb;
  spacing: number;
  size: Rgb;
  valid: SiteFile;
  values: SiteFile;
}

export interface LayerTexture {
  encoding: string;
  type: 'f32' | 'f16' | 'u8' | 'bc6h';
  channels: number;
  planes: number;
  /** 0: illuminance; 1 to 3: how it changes with the normal's x, y, z. */
  coefficient: number;
  groups: number[];
  pages: SiteFile[];
}

export interface Sampler {
  name: string;
  array: boolean;
  linear: boolean;
  slices: { texture: number; plane: number; page: number }[];
}

/** Layers for what a device's textures can do, and the shader that mixes them. */
export interface SiteTier {
  name: string;
  doc: string;
  /** Extensions of WebGL 2. */
  needs: string[];
  shader: string;
  bytes: number;
  /** Per group: what its weight is multiplied by. */
  colors: Rgb[];
  textures: LayerTexture[];
  samplers: Sampler[];
}

export type StreamName =
  | 'indices'
  | 'positions'
  | 'front'
  | 'back'
  | 'base'
  | 'metallic'
  | 'emission'
  | 'normal'
  | 'normals'
  | 'faces'
  | 'tangents';

export interface Site {
  format: string;
  version: number;
  generator: string;
  name: string;
  atlas: { width: number; height: number; pages: number };
  /** Of the light's basis: 1, or 4 where normal maps are seen. */
  coefficients: number;
  groups: LightGroup[];
  cameras: SiteCamera[];
  presets: SitePreset[];
  geometry: {
    vertices: number;
    bounds: [Rgb, Rgb];
    batches: { material: number; group: number; first: number; count: number }[];
    streams: Partial<Record<StreamName, SiteFile>>;
  };
  materials: SiteMaterial[];
  textures: SiteTexture[];
  skies: SiteSky[];
  probes?: SiteProbes;
  meter: {
    points: number;
    weights: SiteFile;
    values: SiteFile;
    emitters: { group: number; luminance: Rgb; weight: number }[];
  };
  tiers: SiteTier[];
  /** Fragment shader text: what is seen of a surface. */
  surface: string;
  tones: { name: string; doc: string; glsl: string }[];
  kelvins: { from: number; step: number; colors: Rgb[] };
}

/** @throws Error where the text is not of a site that this module reads */
export function parseSite(text: string, where: string): Site {
  let site: Site;
  try {
    site = JSON.parse(text) as Site;
  } catch {
    throw new Error(`${where} is not JSON: is it a folder that 'sconce export --web' wrote?`);
  }
  if (site.format !== 'sconce-web') throw new Error(`${where} is no sconce export`);
  if (site.version !== 1) throw new Error(`${where} is of version ${site.version}; this module reads version 1`);
  return site;
}
