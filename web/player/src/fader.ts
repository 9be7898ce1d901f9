// SPDX-License-Identifier: Apache-2.0
// Fader positions, to settings and back. Twin of src/session/fader.h.

import { type LightGroup, parseSetting } from 'sconce-three';

export type FaderColor =
  | { kind: 'own' }
  | { kind: 'kelvin'; kelvin: number }
  | { kind: 'color' | 'tint'; hex: string };

export interface Fader {
  on: boolean;
  /** For looking at one light alone; not part of a mood. */
  solo: boolean;
  /** log2 of the gain; at kLowest the light is out. */
  stops: number;
  color: FaderColor;
}

export const kLowest = -8;
export const kHighest = 4;
export const kPlain: Fader = { on: true, solo: false, stops: 0, color: { kind: 'own' } };

/** @throws Error where the text is no setting */
export function faderOf(text: string, group: LightGroup, before: Fader = kPlain): Fader {
  const setting = parseSetting(text);
  const lumens = setting.lumens === undefined ? 1 : setting.lumens / group.lumens;
  const gain = setting.gain * lumens;
  const hex = /(color:)?(#[0-9a-f]{6})/i.exec(text);
  const color: FaderColor =
    setting.kelvin !== undefined
      ? { kind: 'kelvin', kelvin: setting.kelvin }
      : hex
        ? { kind: hex[1] ? 'color' : 'tint', hex: hex[2]!.toLowerCase() }
        : { kind: 'own' };
  return {
    on: gain > 0,
    solo: before.solo,
    stops: gain > 0 ? Math.max(kLowest, Math.min(kHighest, Math.log2(gain))) : before.stops,
    color,
  };
}

export function colorText(color: FaderColor): string {
  switch (color.kind) {
    case 'own':
      return '';
    case 'kelvin':
      return `${Math.round(color.kelvin)}K`;
    case 'color':
      return `color:${color.hex}`;
    case 'tint':
      return color.hex;
  }
}

export function settingOf(fader: Fader): string {
  if (!fader.on || fader.stops <= kLowest) return 'off';
  const stops = Math.round(fader.stops * 1000) / 1000;
  const parts = [stops === 0 ? '' : `${stops > 0 ? '+' : ''}${stops}ev`, colorText(fader.color)];
  return parts.filter(Boolean).join(',') || 'on';
}

/** As it is to be shown: where some fader is solo, only those shine. */
export function shownSettings(faders: readonly Fader[]): string[] {
  const someSolo = faders.some((fader) => fader.solo);
  return faders.map((fader) => (someSolo && !fader.solo ? 'off' : settingOf(someSolo ? { ...fader, on: true } : fader)));
}

/** `+1.5`, `0`, `out`. */
export function stopsText(fader: Fader): string {
  if (fader.stops <= kLowest) return 'out';
  const text = fader.stops.toFixed(1);
  return text === '0.0' || text === '-0.0' ? '0' : fader.stops > 0 ? `+${text}` : text.replace('-', '−');
}

/** Of a group with this fader; empty where it has none. */
export function lumensText(group: LightGroup, fader: Fader): string {
  if (group.infinite || !(group.lumens > 0)) return '';
  const lumens = fader.on && fader.stops > kLowest ? group.lumens * 2 ** fader.stops : 0;
  return `${lumens >= 100 ? Math.round(lumens).toLocaleString('en') : lumens.toPrecision(2)} lm`.replace(/^0\.0 /, '0 ');
}
