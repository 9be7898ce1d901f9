// SPDX-License-Identifier: Apache-2.0
// The shaders that sconce composed, as materials of three.js.

import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  ClampToEdgeWrapping,
  CustomBlending,
  DataTexture,
  FrontSide,
  GLSL3,
  type IUniform,
  LinearFilter,
  LinearMipmapLinearFilter,
  MirroredRepeatWrapping,
  NearestFilter,
  NoColorSpace,
  OneFactor,
  RepeatWrapping,
  ShaderMaterial,
  SrcColorFactor,
  SRGBColorSpace,
  Texture,
  Vector3,
  ZeroFactor,
} from 'three';

import { fetchBlob, fetchPacked } from './fetch.js';
import type { Site, SiteMaterial, StreamName } from './site.js';

export type Uniforms = Record<string, IUniform>;
/** display: sRGB codes by sconce's own curve. linear: exposed light, for the renderer's tone mapping. */
export type Output = 'display' | 'linear';

// `normal` is an attribute of three.js and a varying of the surface's shader.
const kVertex = `
#define normal surface_normal
in vec2 base_place, metallic_place, emission_place;
in vec3 front_place, back_place;  // u, v in 1/65535, page + 1
#ifdef NORMAL_MAPS
in vec2 normal_place;
in vec3 vertex_normal, vertex_face;
in vec4 vertex_tangent;
#endif

out vec2 base_uv, metallic_uv, emission_uv, normal_uv;
centroid out vec2 front_uv, back_uv;
out vec3 normal;
out vec4 tangent;
flat out vec3 face_normal;
flat out int front_page, back_page;

void main() {
  base_uv = base_place;
  metallic_uv = metallic_place;
  emission_uv = emission_place;
#ifdef NORMAL_MAPS
  normal_uv = normal_place;
  normal = vertex_normal;
  face_normal = vertex_face;
  tangent = vertex_tangent;
#else
  normal_uv = vec2(0.0);
  normal = face_normal = vec3(0.0);
  tangent = vec4(0.0);
#endif
  front_uv = front_place.xy / 65535.0;
  back_uv = back_place.xy / 65535.0;
  front_page = int(front_place.z) - 1;
  back_page = int(back_place.z) - 1;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

/** After the surface's or the sky's main(), which gives cd/m² in `seen`. */
const kFinish: Record<Output, string> = {
  display: '  seen = vec4(linear_to_srgb(tone_map(seen.rgb * sconce_exposure, sconce_tone)), 1.0);\n',
  linear: `  seen = vec4(seen.rgb * sconce_exposure, 1.0);
#define gl_FragColor seen
#include <tonemapping_fragment>
#include <colorspace_fragment>
`,
};

/**
 * Panes are drawn twice: what passes multiplies the picture behind, what they show is added. Sconce.render() blends light,
 * from the farthest to the nearest; who draws by the renderer alone has codes blended, as everywhere on the web, where a tint multiplies as
 * light does.
 */
const kPaneFinish: Record<Output, string> = {
  display: `#if PANES == 1
  seen = vec4(pane_clear + (1.0 - pane_clear) * linear_to_srgb(pane_tint), 1.0);
#else
  float kept = 1.0 - transmission;  // what glass adds, where it is as bright as what is behind
  vec3 all = linear_to_srgb(tone_map(seen.rgb / max(kept, 1e-4) * sconce_exposure, sconce_tone));
  seen = vec4((1.0 - pane_clear) * all * (linear_to_srgb(pane_tint + kept) - linear_to_srgb(pane_tint)), 1.0);
#endif
`,
  linear: `#define gl_FragColor seen
#if PANES == 1
  seen = vec4(pane_tint, 1.0);
  #include <colorspace_fragment>
  seen.rgb = pane_clear + (1.0 - pane_clear) * seen.rgb;
#else
  seen = vec4(seen.rgb * sconce_exposure, 1.0);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
  seen.rgb *= 1.0 - pane_clear;
#endif
`,
};

function finished(main: string, tone: string, output: Output): string {
  return `${main}
${tone}
uniform ToneParams sconce_tone;
uniform float sconce_exposure;
uniform int sconce_read;  // instead of a picture: 1: lux, 2: cd/m2, 3: exposed light

void main() {
#ifdef PANES
  if (sconce_read == 1 || sconce_read == 2) discard;  // the light behind is read
#endif
  sconce_main();
  if (sconce_read == 1) seen = vec4(sconce_lux, 1.0);
  if (sconce_read == 3) {
#if defined(PANES) && PANES == 1
    seen = vec4(pane_clear + (1.0 - pane_clear) * pane_tint, 1.0);
#else
    seen = vec4(min(seen.rgb * sconce_exposure, 6e4), 1.0);  // a half ends at 65504
#ifdef PANES
    seen.rgb *= 1.0 - pane_clear;
#endif
#endif
  }
  if (sconce_read != 0) return;
#ifdef PANES
${kPaneFinish[output]}#else
${kFinish[output]}#endif
}
`;
}

/** @param mixing the tier's shader */
export function surfaceShader(site: Site, mixing: string, tone: string, output: Output): string {
  const surface = `
${mixing}
vec3 sconce_lux = vec3(0.0);
vec3 illuminance(vec2 uv, int page, vec3 offset) {
  return sconce_lux = sconce_illuminance(uv, page${site.coefficients > 1 ? ', offset' : ''});
}
#define normal surface_normal
#define main sconce_main
${site.surface}
#undef main
`;
  return finished(surface, tone, output);
}

/** Whether what is behind shows through. */
export function isPane(m: SiteMaterial): boolean {
  return m.blends || m.transmission > 0;
}

/** How a batch is drawn: as an opaque surface, or as a pane: what passes it, then what it shows itself. */
export type Pass = 'opaque' | 'passing' | 'own';

export function surfaceMaterial(
  site: Site,
  batch: Site['geometry']['batches'][number],
  pictures: IUniform<Texture>[],
  weights: Vector3[],
  shared: Uniforms,
  side: typeof FrontSide | typeof BackSide,
  pass: Pass,
): ShaderMaterial {
  const m: SiteMaterial = site.materials[batch.material]!;
  const pane = pass !== 'opaque';
  const map = (index: number): IUniform => pictures[index] ?? { value: kWhite };
  return new ShaderMaterial({
    name: m.name,
    glslVersion: GLSL3,
    side,
    visible: pane === isPane(m),
    ...(pane && {
      transparent: true,
      depthWrite: false,
      blending: CustomBlending,
      blendSrc: pass === 'passing' ? ZeroFactor : OneFactor,
      blendDst: pass === 'passing' ? SrcColorFactor : OneFactor,
      blendSrcAlpha: ZeroFactor,
      blendDstAlpha: OneFactor,
    }),
    // Fronts win where both meet at an edge, and depth is too coarse to tell.
    polygonOffset: side === BackSide,
    polygonOffsetFactor: 4,
    polygonOffsetUnits: 64,
    // three.js turns the winding round to draw backs.
    defines: {
      ...(side === BackSide ? { gl_FrontFacing: '(!gl_FrontFacing)' } : {}),
      ...(site.coefficients > 1 ? { NORMAL_MAPS: '' } : {}),
      ...(pane ? { PANES: pass === 'passing' ? 1 : 2 } : {}),
    },
    vertexShader: kVertex,
    uniforms: {
      ...shared,
      base_map: map(m.baseMap),
      metallic_map: map(m.metallicMap),
      emission_map: map(m.emissionMap),
      normal_map: map(m.normalMap),
      has_normal_map: { value: m.normalMap >= 0 },
      normal_scale: { value: m.normalScale },
      base_color: { value: new Vector3(...m.baseColor) },
      alpha: { value: m.alpha },
      alpha_cutoff: { value: m.alphaCutoff },
      metallic: { value: m.metallic },
      emission: { value: new Vector3(...m.emission) },
      weight: { value: weights[batch.group] ?? new Vector3(1, 1, 1) },
      double_sided: { value: m.doubleSided },
      blends: { value: m.blends },
      transmission: { value: m.transmission },
    },
  });
}

const kMovableVertex = `
out vec3 sconce_normal;
void main() {
  sconce_normal = mat3(modelMatrix) * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}
`;

/** A diffuse thing of one albedo in the light of probes. */
export function movableShader(tone: string, output: Output): string {
  return finished(
    `in vec3 sconce_normal;
out vec4 seen;
uniform vec3 albedo, sconce_probe[4];
vec3 sconce_lux = vec3(0.0);
void sconce_main() {
  vec3 n = normalize(sconce_normal);
  sconce_lux = max(vec3(0.0), sconce_probe[0] + n.x * sconce_probe[1] + n.y * sconce_probe[2] + n.z * sconce_probe[3]);
  seen = vec4(albedo * sconce_lux * 0.318309886, 1.0);
}
`,
    tone,
    output,
  );
}

export function movableMaterial(uniforms: Uniforms): ShaderMaterial {
  return new ShaderMaterial({ name: 'movable', glslVersion: GLSL3, vertexShader: kMovableVertex, uniforms });
}

/** Stands for pictures that are not there, or not yet. */
export const kWhite: Texture = new DataTexture(new Uint8Array([255, 255, 255, 255]), 1, 1);
kWhite.needsUpdate = true;

const kWraps: Record<string, typeof RepeatWrapping | typeof ClampToEdgeWrapping | typeof MirroredRepeatWrapping> = {
  repeat: RepeatWrapping,
  clamp: ClampToEdgeWrapping,
  mirror: MirroredRepeatWrapping,
};

/** Of the site's pictures. */
export async function loadPicture(site: Site, index: number, base: string, signal?: AbortSignal): Promise<Texture> {
  const entry = site.textures[index]!;
  const bitmap = await createImageBitmap(await fetchBlob(base + entry.file, signal), {
    premultiplyAlpha: 'none',
    colorSpaceConversion: 'none',
  });
  const texture = new Texture(bitmap);
  const isData = site.materials.some((m) => m.metallicMap === index || m.normalMap === index);
  texture.colorSpace = isData ? NoColorSpace : SRGBColorSpace;
  texture.flipY = false;
  texture.wrapS = kWraps[entry.wrap?.[0] ?? 'repeat']!;
  texture.wrapT = kWraps[entry.wrap?.[1] ?? 'repeat']!;
  texture.magFilter = entry.nearest ? NearestFilter : LinearFilter;
  texture.minFilter = entry.nearest ? NearestFilter : LinearMipmapLinearFilter;
  texture.generateMipmaps = !entry.nearest;
  texture.anisotropy = 8;
  texture.needsUpdate = true;
  return texture;
}

/** n: unit vectors in 1/32767. */
const kStreams: Record<StreamName, [name: string, numbers: number, kind: 'f' | 's' | 'i' | 'n']> = {
  indices: ['', 1, 'i'],
  positions: ['position', 3, 'f'],
  front: ['front_place', 3, 's'],
  back: ['back_place', 3, 's'],
  base: ['base_place', 2, 'f'],
  metallic: ['metallic_place', 2, 'f'],
  emission: ['emission_place', 2, 'f'],
  normal: ['normal_place', 2, 'f'],
  normals: ['vertex_normal', 3, 'n'],
  faces: ['vertex_face', 3, 'n'],
  tangents: ['vertex_tangent', 4, 'n'],
};

const kArrays = { f: Float32Array, s: Uint16Array, i: Uint32Array, n: Int16Array };

/** @throws Error in words for people */
export async function loadGeometry(
  site: Site,
  base: string,
  arrived: (bytes: number) => void,
  signal?: AbortSignal,
): Promise<BufferGeometry> {
  const geometry = new BufferGeometry();
  const load = async (stream: StreamName) => {
    const file = site.geometry.streams[stream];
    if (!file) return;
    const [name, numbers, kind] = kStreams[stream];
    const data = await fetchPacked(base + file.file, numbers * (kind === 's' || kind === 'n' ? 2 : 4), arrived, signal);
    const array = new kArrays[kind](data);
    if (stream === 'indices') geometry.setIndex(new BufferAttribute(array, 1));
    else geometry.setAttribute(name, new BufferAttribute(array, numbers, kind === 'n'));
  };
  await Promise.all((Object.keys(kStreams) as StreamName[]).map(load));
  site.geometry.batches.forEach((batch, i) => geometry.addGroup(batch.first, batch.count, i));
  return geometry;
}

const kSkyVertex = `
out vec3 sconce_direction;
void main() {
  gl_Position = vec4(position.xy, 1.0, 1.0);
  vec4 far = inverse(projectionMatrix) * gl_Position;
  sconce_direction = inverse(mat3(modelViewMatrix)) * (far.xyz / far.w);
}
`;

/** Twin of src/light/sky.cpp for all skies at once: lat-long, row 0 up, the centre column towards -z. */
export function skyShader(count: number, tone: string, output: Output): string {
  let main = `in vec3 sconce_direction;
out vec4 seen;
const vec3 sconce_lux = vec3(0.0);
vec3 sconce_sky(sampler2D image, vec3 d) {
  vec2 place = vec2(0.5 + atan(d.x, -d.z) / 6.28318530718, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265359);
  ivec2 size = textureSize(image, 0);
  vec4 code = floor(texelFetch(image, clamp(ivec2(place * vec2(size)), ivec2(0), size - 1), 0) * 255.0 + 0.5);
  return code.a > 0.0 ? (code.rgb + 0.5) * exp2(code.a - 136.0) : vec3(0.0);
}
`;
  for (let i = 0; i < count; ++i)
    main += `uniform sampler2D sky_${i};\nuniform vec3 sky_scale_${i}, sky_weight_${i};\nuniform mat3 sky_frame_${i};\n`;
  main += 'void sconce_main() {\n  vec3 d = normalize(sconce_direction);\n  seen = vec4(0.0, 0.0, 0.0, 1.0);\n';
  for (let i = 0; i < count; ++i)
    main += `  seen.rgb += sky_weight_${i} * sky_scale_${i} * sconce_sky(sky_${i}, d * sky_frame_${i});\n`;
  return finished(`${main}}\n`, tone, output);
}

export function skyMaterial(uniforms: Uniforms): ShaderMaterial {
  return new ShaderMaterial({
    name: 'sky',
    glslVersion: GLSL3,
    vertexShader: kSkyVertex,
    depthWrite: false,
    uniforms,
  });
}
