// SPDX-License-Identifier: Apache-2.0
// Twin of src/mix/meter.cpp, on the points that the site holds, and of src/tone/exposure.cpp.

import { DataUtils } from 'three';

import type { Rgb, Site } from './site.js';

const kMiddleGrey = 0.18;
const kDarkest = 1e-4; // cd/m²
const kPercentile = 0.999;

export interface Metering {
  /** cd/m² */
  logMean: number;
  /** cd/m² */
  maximum: number;
}

/** exposed = scale * luminance in cd/m²; maximum is an exposed one. */
export interface Exposure {
  scale: number;
  maximum: number;
}

export class Meter {
  private readonly values: Float32Array;
  private readonly luminance: Float32Array;
  private readonly order: Uint32Array;

  constructor(
    private readonly meter: Site['meter'],
    private readonly groups: number,
    private readonly weights: Float32Array,
    halves: Uint16Array,
  ) {
    this.values = Float32Array.from(halves, (half) => DataUtils.fromHalfFloat(half));
    this.luminance = new Float32Array(weights.length + meter.emitters.length);
    this.order = Uint32Array.from(this.luminance, (_, i) => i);
  }

  /** @param mix weight per group */
  measure(mix: readonly Readonly<Rgb>[]): Metering {
    const { values, luminance, weights } = this;
    let total = 0;
    let logSum = 0;
    for (let i = 0, at = 0; i < weights.length; ++i) {
      let sum = 0;
      for (let g = 0; g < this.groups; ++g, at += 3) {
        const w = mix[g]!;
        sum += w[0] * values[at]! + w[1] * values[at + 1]! + w[2] * values[at + 2]!;
      }
      luminance[i] = sum;
      total += weights[i]!;
      logSum += weights[i]! * Math.log(Math.max(0, sum) + kDarkest);
    }
    const weightOf = Float64Array.from(luminance, (_, i) => weights[i] ?? 0);
    this.meter.emitters.forEach((emitter, k) => {
      const w = mix[emitter.group] ?? [1, 1, 1];
      const l = w[0] * emitter.luminance[0] + w[1] * emitter.luminance[1] + w[2] * emitter.luminance[2];
      luminance[weights.length + k] = l;
      weightOf[weights.length + k] = w.some((c) => c !== 0) ? emitter.weight : 0;
    });
    return {
      logMean: total > 0 ? Math.exp(logSum / total) : kDarkest,
      maximum: this.percentile(weightOf),
    };
  }

  private percentile(weightOf: Float64Array): number {
    const { luminance } = this;
    this.order.sort((a, b) => luminance[a]! - luminance[b]!);
    const wanted = kPercentile * weightOf.reduce((sum, w) => sum + w, 0);
    let below = 0;
    for (const i of this.order) {
      below += weightOf[i]!;
      if (weightOf[i]! > 0 && below >= wanted) return luminance[i]!;
    }
    return 0;
  }
}

function scaled(scale: number, maximum: number): Exposure {
  const clamp = (v: number) => Math.min(Math.max(v, 1e-30), 1e30);
  return { scale: clamp(scale), maximum: clamp(scale * Math.max(maximum, kDarkest)) };
}

/** @param stops brighter than automatic */
export function autoExposure(metering: Metering, stops = 0): Exposure {
  return scaled((kMiddleGrey * 2 ** stops) / Math.max(metering.logMean, kDarkest), metering.maximum);
}

/** Absolute: the value 1 is 1.2 * 2^ev100 cd/m². */
export function ev100Exposure(ev100: number, metering: Metering): Exposure {
  return scaled(1 / (1.2 * 2 ** ev100), metering.maximum);
}
