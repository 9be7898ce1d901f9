// SPDX-License-Identifier: Apache-2.0
// One light group's strip: on/off, name, solo, fader, colour.

import type { LightGroup } from 'sconce-three';

import { element } from './dom';
import { colorText, type Fader, type FaderColor, kHighest, kLowest, lumensText, stopsText } from './fader';

const kWhiteHex = '#ffffff';

export class Strip {
  readonly root: HTMLElement;
  private readonly on: HTMLInputElement;
  private readonly solo: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly value: HTMLElement;
  private readonly lumens: HTMLElement;
  private readonly kind: HTMLSelectElement;
  private readonly kelvin: HTMLInputElement;
  private readonly picker: HTMLInputElement;
  private readonly swatch: HTMLElement;

  constructor(
    private readonly group: LightGroup,
    private fader: Fader,
    private readonly onChange: (fader: Fader) => void,
    private readonly shownColor: (color: FaderColor) => string,
  ) {
    const { name } = group;
    this.on = element('input', { type: 'checkbox', role: 'switch', 'aria-label': `${name} on` });
    this.solo = element('button', { type: 'button', class: 'solo', 'aria-label': `${name} alone`, title: 'This light alone' }, 'solo');
    this.slider = element('input', {
      type: 'range', min: kLowest, max: kHighest, step: 0.1, 'aria-label': `${name} brightness, in stops`,
    });
    this.value = element('b', { 'aria-hidden': 'true' });
    this.lumens = element('small', { 'aria-hidden': 'true' });
    this.kind = element(
      'select', { 'aria-label': `${name} colour` },
      element('option', { value: 'own' }, 'own colour'),
      element('option', { value: 'kelvin' }, 'kelvin'),
      element('option', { value: 'color' }, 'colour'),
      element('option', { value: 'tint' }, 'tint'),
    );
    this.kelvin = element('input', {
      type: 'range', min: 1000, max: 11000, step: 100, class: 'kelvin', 'aria-label': `${name} colour temperature, in kelvin`,
    });
    this.picker = element('input', { type: 'color', 'aria-label': `${name} colour to take` });
    this.swatch = element('i', { class: 'swatch', 'aria-hidden': 'true' });
    const title = group.lamps.length > 0 ? `Lamps: ${group.lamps.join(', ')}` : undefined;
    this.root = element(
      'li', { class: 'strip' },
      element('div', { class: 'top' }, element('label', { title }, this.on, element('span', {}, name)), this.lumens),
      element('div', { class: 'middle' }, this.slider, this.value),
      element('div', { class: 'bottom' }, this.swatch, this.kind, this.kelvin, this.picker, this.solo),
    );
    this.listen();
    this.show(fader);
  }

  show(fader: Fader): void {
    this.fader = fader;
    const { color } = fader;
    this.on.checked = fader.on;
    this.solo.setAttribute('aria-pressed', String(fader.solo));
    this.slider.value = String(fader.stops);
    this.value.textContent = stopsText(fader);
    this.lumens.textContent = lumensText(this.group, fader);
    const spoken = fader.stops <= kLowest ? 'out' : `${fader.stops.toFixed(1)} stops`;
    this.slider.setAttribute('aria-valuetext', [spoken, this.lumens.textContent].filter(Boolean).join(', '));
    this.slider.style.setProperty('--at', `${((fader.stops - kLowest) / (kHighest - kLowest)) * 100}%`);
    this.kind.value = color.kind;
    this.kelvin.hidden = color.kind !== 'kelvin';
    this.picker.hidden = color.kind !== 'color' && color.kind !== 'tint';
    if (color.kind === 'kelvin') {
      this.kelvin.value = String(color.kelvin);
      this.kelvin.title = colorText(color);
      this.kelvin.setAttribute('aria-valuetext', `${color.kelvin} kelvin`);
    }
    if (color.kind === 'color' || color.kind === 'tint') this.picker.value = color.hex;
    this.swatch.style.background = this.shownColor(color);
    this.root.classList.toggle('dark', !fader.on || fader.stops <= kLowest);
  }

  private change(part: Partial<Fader>): void {
    this.show({ ...this.fader, ...part });
    this.onChange(this.fader);
  }

  private listen(): void {
    this.on.addEventListener('change', () => this.change({ on: this.on.checked }));
    this.solo.addEventListener('click', () => this.change({ solo: !this.fader.solo }));
    this.slider.addEventListener('input', () => this.change({ stops: Number(this.slider.value), on: true }));
    this.slider.addEventListener('dblclick', () => this.change({ stops: 0, on: true }));
    this.kelvin.addEventListener('input', () => this.change({ color: { kind: 'kelvin', kelvin: Number(this.kelvin.value) } }));
    this.picker.addEventListener('input', () => {
      if (this.kind.value === 'color' || this.kind.value === 'tint')
        this.change({ color: { kind: this.kind.value, hex: this.picker.value } });
    });
    this.kind.addEventListener('change', () => this.change({ color: firstColor(this.kind.value) }));
  }
}

function firstColor(kind: string): FaderColor {
  if (kind === 'kelvin') return { kind, kelvin: 2700 };
  if (kind === 'color' || kind === 'tint') return { kind, hex: kWhiteHex };
  return { kind: 'own' };
}
