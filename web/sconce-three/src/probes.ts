// SPDX-License-Identifier: Apache-2.0
// Light for what moves: a grid of points with the light of every group from all around (bake --probes).

import { type Arrived, fetchPacked } from './fetch.js';
import type { Rgb, SiteProbes } from './site.js';

/** e, then g of x, y and z, lux: what faces the unit n receives max(0, e + g · n). */
export type ProbeLight = [Rgb, Rgb, Rgb, Rgb];

/** Twin of ProbeGrid, src/package/points.h. */
export class Probes {
  constructor(
    private readonly site: SiteProbes,
    private readonly groups: number,
    private readonly valid: Uint8Array,
    private readonly values: Float32Array,
  ) {}

  /** Trilinear between the valid ones of the eight probes around; points outside count as at the border. */
  mixed(point: Readonly<Rgb>, weights: readonly Readonly<Rgb>[]): ProbeLight {
    const { origin, spacing, size } = this.site;
    const place = point.map((p, axis) => Math.min(Math.max((p - origin[axis]!) / spacing, 0), size[axis]! - 1));
    const low = place.map((p, axis) => Math.min(Math.floor(p), Math.max(size[axis]! - 2, 0)));
    const light: ProbeLight = [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]];
    let all = 0;
    for (let corner = 0; corner < 8; ++corner) {
      let share = 1;
      const [x, y, z] = low.map((l, axis) => {
        const up = (corner >> axis) & 1;
        const part = place[axis]! - l;
        share *= up ? part : 1 - part;
        return l + up;
      }) as Rgb;
      const probe = (z * size[1] + y) * size[0] + x;
      if (!(share > 0) || !this.valid[probe]) continue;
      all += share;
      weights.forEach((weight, g) => {
        const first = 12 * (probe * this.groups + g);
        for (let k = 0; k < 12; ++k) light[Math.floor(k / 3)]![k % 3]! += share * weight[k % 3]! * this.values[first + k]!;
      });
    }
    if (all > 0) for (const k of light) k.forEach((v, c) => (k[c] = v / all));
    return light;
  }
}

/** @throws Error in words for people */
export async function loadProbes(
  site: SiteProbes | undefined,
  groups: number,
  base: string,
  arrived: Arrived,
  signal?: AbortSignal,
): Promise<Probes | undefined> {
  if (!site) return undefined;
  const [valid, values] = await Promise.all([
    fetchPacked(base + site.valid.file, 1, arrived, signal),
    fetchPacked(base + site.values.file, 48 * groups, arrived, signal),
  ]);
  return new Probes(site, groups, new Uint8Array(valid), new Float32Array(values));
}
