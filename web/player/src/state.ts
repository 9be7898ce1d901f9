// SPDX-License-Identifier: Apache-2.0
// What the panel, the picture and other windows share.

import { type ExposureMode, type Sconce, settingsOf, type SitePreset } from 'sconce-three';

import { type Fader, faderOf, kPlain, settingOf, shownSettings } from './fader';

const kFade = 600; // ms

/** What is shared between windows: texts as in a preset's file. */
export interface SharedMix {
  settings: Record<string, string>;
  exposure: string;
  ev100: string;
  tone: string;
  /** The window that changed it. */
  from?: string;
}

export class State {
  faders: Fader[];
  /** The mood that is shown, while nothing has been changed since. */
  mood: SitePreset | undefined;
  /** Someone but the panel changed something. */
  onShow: () => void = () => {};
  /** This window changed something. */
  onEdit: () => void = () => {};

  private fade = 0;

  constructor(readonly sconce: Sconce) {
    this.faders = sconce.groups.map(() => kPlain);
  }

  setFader(index: number, fader: Fader): void {
    this.faders = this.faders.map((old, g) => (g === index ? fader : old));
    this.apply();
    this.edited();
  }
  setExposure(mode: ExposureMode): void {
    this.sconce.exposure = mode;
    this.edited();
  }
  setTone(name: string): void {
    this.sconce.tone = name;
    this.edited();
  }

  /** Fades to a mood. */
  applyPreset(preset: SitePreset): void {
    const texts = settingsOf(this.sconce.site.groups, preset.settings, preset.others);
    this.faders = texts.map((text, g) => ({ ...faderOf(text, this.sconce.groups[g]!, this.faders[g]), solo: false }));
    this.fadeTo(texts);
    if (preset.tone) this.sconce.tone = preset.tone;
    if (preset.ev100) this.sconce.exposure = { ev100: Number(preset.ev100) };
    else if (preset.exposure) this.sconce.exposure = { stops: Number(preset.exposure) || 0 };
    this.mood = preset;
    this.onShow();
    this.onEdit();
  }

  get shared(): SharedMix {
    const mode = this.sconce.exposure;
    const settings = Object.fromEntries(this.faders.map((f, g) => [this.sconce.groups[g]!.name, settingOf(f)]));
    return {
      settings,
      exposure: 'stops' in mode ? (mode.stops === 0 ? 'auto' : String(mode.stops)) : '',
      ev100: 'ev100' in mode ? String(mode.ev100) : '',
      tone: this.sconce.tone,
    };
  }
  /** What another window, or a script, has set. */
  set shared(mix: SharedMix) {
    this.faders = this.sconce.groups.map((group, g) =>
      faderOf(mix.settings[group.name] ?? 'on', group, this.faders[g]),
    );
    this.sconce.tone = mix.tone || 'agx';
    this.sconce.exposure = mix.ev100 ? { ev100: Number(mix.ev100) } : { stops: Number(mix.exposure) || 0 };
    this.mood = undefined;
    this.apply();
    this.onShow();
  }

  private edited(): void {
    if (this.mood) {
      this.mood = undefined;
      this.onShow();
    }
    this.onEdit();
  }

  private apply(): void {
    cancelAnimationFrame(this.fade);
    this.sconce.setSettings(shownSettings(this.faders));
  }

  /** Light itself is faded, so that every moment is a sum of both. */
  private fadeTo(texts: string[]): void {
    cancelAnimationFrame(this.fade);
    const from = this.sconce.groups.map((_, g) => this.sconce.weight(g));
    this.sconce.setSettings(texts);
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return;
    const to = this.sconce.groups.map((_, g) => this.sconce.weight(g));
    const start = performance.now();
    const step = (now: number) => {
      const t = Math.min(1, Math.max(0, (now - start) / kFade));
      this.sconce.setWeights(from.map((a, g) => [0, 1, 2].map((c) => a[c]! + t * (to[g]![c]! - a[c]!)) as [number, number, number]));
      if (t < 1) this.fade = requestAnimationFrame(step);
    };
    this.fade = requestAnimationFrame(step);
  }
}
