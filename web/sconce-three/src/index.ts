// SPDX-License-Identifier: Apache-2.0
// Light-group lightmaps baked by sconce as a three.js object whose lamps you can still change.

import { Meter } from './exposure.js';
import { fetchPacked, fetchText } from './fetch.js';
import { Layers } from './layers.js';
import { loadGeometry, type Output } from './materials.js';
import { loadProbes } from './probes.js';
import { Sconce } from './sconce.js';
import { parseSite, type Site, type SiteTier } from './site.js';

export type { Exposure, Metering } from './exposure.js';
export type { Output } from './materials.js';
export type { ProbeLight } from './probes.js';
export { type ExposureMode, type Reading, Sconce } from './sconce.js';
export { groupWeight, kelvinColor, parseSetting, type Setting, settingsOf, srgbToLinear } from './setting.js';
export type { LightGroup, Rgb, Site, SiteCamera, SitePreset, SiteTier } from './site.js';

export interface LoadOptions {
  /** Layers to load, by the tier's name; the best that the device can show otherwise. */
  tier?: string;
  /** `display` (the default): finished colours by sconce's tone curves. `linear`: for the renderer's own. */
  output?: Output;
  /** Bytes of what is loaded packed. */
  onProgress?: (loaded: number, total: number) => void;
  /** Do not start Sconce.load(). */
  lazy?: boolean;
  signal?: AbortSignal;
}

/** Can textures of this tier be shown? */
export function isShown(tier: SiteTier, gl: WebGL2RenderingContext): boolean {
  return tier.needs.every((name) => gl.getExtension(name) !== null);
}

/** A context of its own, to ask what the device can do. */
function probe(): WebGL2RenderingContext {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) throw new Error('this browser has no WebGL 2');
  return gl;
}

function chooseTier(site: Site, name?: string): SiteTier {
  const gl = probe();
  const usable = site.tiers.filter((tier) => isShown(tier, gl));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  const tier = name === undefined ? usable[0] : usable.find((t) => t.name === name);
  if (!tier) {
    const names = usable.map((t) => t.name).join(', ');
    throw new Error(name === undefined ? 'this device can show none of the layers' : `no layers '${name}' here (allowed: ${names})`);
  }
  return tier;
}

/** Bytes that loading a tier takes, but for pictures and text. */
function bytesOf(site: Site, tier: SiteTier): number {
  const probes = site.probes ? [site.probes.valid, site.probes.values] : [];
  const files = [...Object.values(site.geometry.streams), ...site.skies, site.meter.weights, site.meter.values, ...probes];
  return files.reduce((sum, file) => sum + file.bytes, tier.bytes);
}

/**
 * Loads what `sconce export --web` wrote.
 * @param url of the folder that holds sconce.json
 * @returns as soon as there is a shape; light arrives layer by layer, see Sconce.onChange
 * @throws Error in words for people: nothing there, WebGL 2 missing, another version
 */
export async function loadSconce(url: string | URL, options: LoadOptions = {}): Promise<Sconce> {
  const base = new URL(String(url).replace(/\/?$/, '/'), document.baseURI).href;
  const { signal } = options;
  const site = parseSite(await fetchText(`${base}sconce.json`, signal), `${base}sconce.json`);
  const tier = chooseTier(site, options.tier);
  const total = bytesOf(site, tier);
  let loaded = 0;
  const arrived = (bytes: number) => options.onProgress?.((loaded += bytes), total);

  const { meter } = site;
  const [mixing, geometry, weights, values, probes] = await Promise.all([
    fetchText(base + tier.shader, signal),
    loadGeometry(site, base, arrived, signal),
    fetchPacked(base + meter.weights.file, 4, arrived, signal),
    fetchPacked(base + meter.values.file, 6 * site.groups.length, arrived, signal),
    loadProbes(site.probes, site.groups.length, base, arrived, signal),
  ]);
  const sconce = new Sconce(
    site,
    base,
    mixing,
    new Layers(site, tier, base),
    new Meter(meter, site.groups.length, new Float32Array(weights), new Uint16Array(values)),
    geometry,
    probes,
    options.output ?? 'display',
    loaded,
    total,
  );
  if (options.onProgress) sconce.onProgress = options.onProgress;
  if (!options.lazy) sconce.load(signal).catch((error: unknown) => sconce.onError(error as Error));
  return sconce;
}
