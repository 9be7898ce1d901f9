// SPDX-License-Identifier: Apache-2.0
// `GROUP=SETTING` text to weights: twin of src/mix/settings.cpp and make_mix.cpp.

import type { LightGroup, Rgb, Site } from './site.js';

/** One group's setting. Colours are linear. */
export interface Setting {
  /** Product of gains and 2^ev; 0 = off. */
  gain: number;
  /** Replaces the group's flux. */
  lumens?: number;
  /** Replaces the colour, keeps the flux. */
  kelvin?: number;
  color?: Rgb;
  /** Multiplies. */
  tint?: Rgb;
}

const kAllowed = 'off, on, 0.5, 50%, +1.5ev, 800lm, 2700K, color:#rrggbb, #rrggbb, joined by commas';

export function srgbToLinear(c: number): number {
  return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
}

export function luminance(c: Readonly<Rgb>): number {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

function hexColor(text: string): Rgb | undefined {
  const match = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/.exec(text);
  return match?.slice(1).map((code) => srgbToLinear(parseInt(code, 16) / 255)) as Rgb | undefined;
}

function numberBefore(term: string, unit: string): number | undefined {
  if (!term.endsWith(unit)) return undefined;
  const text = term.slice(0, term.length - unit.length);
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/.test(text) ? Number(text) : undefined;
}

/** @throws Error saying what is allowed */
export function parseSetting(text: string): Setting {
  const fail = (what: string): never => {
    throw new Error(`setting '${text}' ${what} (allowed: ${kAllowed})`);
  };
  const setting: Setting = { gain: 1 };
  const gain = (factor: number) => {
    if (factor < 0) fail('is negative');
    setting.gain *= factor;
  };
  const oneColor = () => {
    if (setting.kelvin !== undefined || setting.color || setting.tint) fail('has two colours');
  };
  for (const part of text.split(',')) {
    const term = part.trim().toLowerCase();
    if (term === 'on') continue;
    const ev = numberBefore(term, 'ev');
    const percent = numberBefore(term, '%');
    const plain = numberBefore(term, '');
    const lumens = numberBefore(term, 'lm');
    const kelvin = numberBefore(term, 'k');
    if (term === 'off') gain(0);
    else if (ev !== undefined) gain(2 ** ev);
    else if (percent !== undefined) gain(percent / 100);
    else if (plain !== undefined) gain(plain);
    else if (lumens !== undefined) {
      if (setting.lumens !== undefined) fail('has two fluxes');
      if (lumens < 0) fail('is negative');
      setting.lumens = lumens;
    } else if (kelvin !== undefined) {
      oneColor();
      if (!(kelvin >= 1000 && kelvin <= 11000)) fail('is outside 1000K to 11000K');
      setting.kelvin = kelvin;
    } else {
      const replaces = term.startsWith('color:');
      const color = hexColor(replaces ? term.slice(6) : term) ?? fail('is not understood');
      oneColor();
      if (replaces && color.every((c) => c === 0)) fail('has no colour to give: black');
      if (replaces) setting.color = color;
      else setting.tint = color;
    }
  }
  if (!Number.isFinite(setting.gain)) fail('is too strong');
  return setting;
}

/** Black body of luminance 1, linear Rec. 709, from the site's table. */
export function kelvinColor(kelvins: Site['kelvins'], kelvin: number): Rgb {
  const last = kelvins.colors.length - 1;
  const at = Math.min(Math.max((kelvin - kelvins.from) / kelvins.step, 0), last);
  const low = Math.min(Math.floor(at), last - 1);
  const a = kelvins.colors[low]!;
  const b = kelvins.colors[low + 1]!;
  return a.map((v, c) => v + (at - low) * (b[c]! - v)) as Rgb;
}

/** Linear weight of a group. @throws Error where it has no lumens to replace */
export function groupWeight(group: LightGroup, setting: Setting, kelvins: Site['kelvins']): Rgb {
  let gain = setting.gain;
  if (setting.lumens !== undefined) {
    if (group.infinite) throw new Error(`group '${group.name}' shines from infinity and has no lumens`);
    if (!(group.lumens > 0)) throw new Error(`group '${group.name}': its lumens are not known`);
    gain *= setting.lumens / group.lumens;
  }
  const target =
    setting.kelvin !== undefined
      ? kelvinColor(kelvins, setting.kelvin)
      : (setting.color?.map((c) => c / luminance(setting.color!)) as Rgb | undefined);
  if (!target) return (setting.tint ?? [1, 1, 1]).map((c) => c * gain) as Rgb;
  return target.map((c, i) => (group.color[i]! > 0 ? (gain * c) / group.color[i]! : 0)) as Rgb;
}

function globPattern(glob: string): RegExp {
  const text = glob.replace(/[.+^${}()|\\]/g, '\\$&').replace(/\*/g, '.*').replace(/\?/g, '.');
  return new RegExp(`^${text}$`, 's');
}

/**
 * Settings of all groups, as texts. Later assignments win; groups that none names get `others`.
 * @throws Error naming the groups
 */
export function settingsOf(groups: LightGroup[], assignments: string[], others: string): string[] {
  const settings = groups.map(() => others || 'on');
  for (const text of assignments) {
    const quoted = /^(["'])(.*)\1=([^=]*)$/s.exec(text);
    const plain = /^(.+)=([^=]*)$/s.exec(text);
    const name = quoted ? quoted[2]! : plain?.[1];
    if (name === undefined) throw new Error(`'${text}' is no group setting (allowed: GROUP=SETTING)`);
    const setting = quoted ? quoted[3]! : plain![2]!;
    parseSetting(setting);
    let found = groups.map((group) => group.name === name);
    if (!quoted && !found.some(Boolean)) {
      const pattern = globPattern(name);
      found = groups.map((group) => name === 'all' || pattern.test(group.name));
    }
    if (!found.some(Boolean))
      throw new Error(`unknown light group '${name}' (allowed: ${groups.map((g) => g.name).join(', ')})`);
    found.forEach((is, g) => {
      if (is) settings[g] = setting;
    });
  }
  return settings;
}
