// SPDX-License-Identifier: Apache-2.0
// The panel: moods, strips, camera, exposure, curve.

import { kelvinColor, type SitePreset } from 'sconce-three';

import { element } from './dom';
import { type FaderColor, kPlain } from './fader';
import type { Look } from './look';
import type { State } from './state';
import { Strip } from './strip';

const kRoomy = 8; // strips; of more, colours stand beside the fader

function display(linear: readonly number[]): string {
  const most = Math.max(...linear, 1e-6);
  const code = (c: number) => {
    const v = Math.min(1, c / most);
    return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
  };
  return `rgb(${linear.map(code).join(' ')})`;
}

function labelled(text: string, control: HTMLElement): HTMLElement {
  control.setAttribute('aria-label', text);
  return element('div', { class: 'row' }, element('span', { 'aria-hidden': 'true' }, text), control);
}

export class Panel {
  private readonly strips: Strip[];
  private readonly moodButtons: HTMLButtonElement[];
  private readonly tone: HTMLSelectElement;
  private readonly absolute: HTMLSelectElement;
  private readonly exposure: HTMLInputElement;
  private readonly exposureText = element('b', { 'aria-hidden': 'true' });

  constructor(
    root: HTMLElement,
    private readonly state: State,
    private readonly look: Look,
  ) {
    const { sconce } = state;
    const shownColor = (g: number) => (color: FaderColor) =>
      color.kind === 'own'
        ? display(sconce.groups[g]!.color)
        : color.kind === 'kelvin'
          ? display(kelvinColor(sconce.site.kelvins, color.kelvin))
          : color.hex;
    this.strips = sconce.groups.map(
      (group, g) => new Strip(group, state.faders[g]!, (fader) => state.setFader(g, fader), shownColor(g)),
    );
    this.tone = element('select', {}, ...sconce.site.tones.map((t) => element('option', { value: t.name, title: t.doc }, t.name)));
    this.tone.addEventListener('change', () => state.setTone(this.tone.value));
    this.absolute = element(
      'select', { 'aria-label': 'Kind of exposure' },
      element('option', { value: 'auto' }, 'automatic'),
      element('option', { value: 'ev100' }, 'EV 100'),
    );
    this.exposure = element('input', { type: 'range', step: 0.1 });
    this.absolute.addEventListener('change', () => this.changeKind());
    this.exposure.addEventListener('input', () => this.changeExposure());
    this.exposure.addEventListener('dblclick', () => state.setExposure({ stops: 0 }));

    this.moodButtons = sconce.presets.map((preset) => {
      const button = element('button', { type: 'button' }, preset.name);
      button.addEventListener('click', () => this.start(preset));
      return button;
    });

    const reset = element('button', { type: 'button' }, 'Reset');
    reset.addEventListener('click', () => this.reset());
    const copy = element('button', { type: 'button', title: 'The settings as words for sconce render and sconce mix' }, 'Copy settings');
    copy.addEventListener('click', () => void this.copy(copy));

    root.replaceChildren(
      element('header', {}, element('h1', {}, sconce.name || 'sconce'), reset),
      ...(this.moodButtons.length > 0 ? [element('nav', { class: 'moods', 'aria-label': 'Moods' }, ...this.moodButtons)] : []),
      element('ul', { class: this.strips.length > kRoomy ? 'strips many' : 'strips', 'aria-label': 'Lights' }, ...this.strips.map((strip) => strip.root)),
      element(
        'section', { class: 'picture', 'aria-label': 'Picture' },
        ...this.cameras(),
        element('div', { class: 'row' }, element('span', {}, 'Exposure'), this.absolute),
        element('div', { class: 'middle' }, this.exposure, this.exposureText),
        labelled('Tone curve', this.tone),
        copy,
      ),
    );
    this.show();
  }

  show(): void {
    this.state.faders.forEach((fader, g) => this.strips[g]!.show(fader));
    this.moodButtons.forEach((button, i) =>
      button.setAttribute('aria-pressed', String(this.state.mood === this.state.sconce.presets[i])),
    );
    this.tone.value = this.state.sconce.tone;
    const mode = this.state.sconce.exposure;
    const isAbsolute = 'ev100' in mode;
    this.absolute.value = isAbsolute ? 'ev100' : 'auto';
    this.exposure.min = isAbsolute ? '-2' : '-6';
    this.exposure.max = isAbsolute ? '18' : '6';
    const value = isAbsolute ? mode.ev100 : mode.stops;
    this.exposure.value = String(value);
    this.exposure.setAttribute('aria-label', isAbsolute ? 'Exposure value at ISO 100' : 'Exposure, in stops from automatic');
    this.exposure.style.setProperty(
      '--at', `${((value - Number(this.exposure.min)) / (Number(this.exposure.max) - Number(this.exposure.min))) * 100}%`,
    );
    const text = value.toFixed(1);
    this.exposureText.textContent = isAbsolute ? text : Math.abs(value) < 0.05 ? '0' : value > 0 ? `+${text}` : text.replace('-', '−');
  }

  /** Fades to a mood, its camera too. */
  start(preset: SitePreset): void {
    this.state.applyPreset(preset);
    const camera = this.state.sconce.site.cameras.findIndex((c) => c.name === preset.camera);
    if (camera >= 0) this.look.show(camera);
  }

  private cameras(): HTMLElement[] {
    const { cameras } = this.state.sconce.site;
    const select = element('select', {}, ...cameras.map((c, i) => element('option', { value: i }, c.name || `camera ${i + 1}`)));
    select.addEventListener('change', () => this.look.show(Number(select.value)));
    const again = element('button', { type: 'button', title: 'Back to where the camera stood' }, 'Go');
    again.addEventListener('click', () => this.look.show(Number(select.value)));
    return [element('div', { class: 'row' }, labelled('Camera', select), again)];
  }

  private changeKind(): void {
    const { sconce } = this.state;
    if (this.absolute.value === 'auto') this.state.setExposure({ stops: 0 });
    // As bright as it is now.
    else this.state.setExposure({ ev100: Math.round(10 * Math.log2(sconce.metering().logMean / (1.2 * 0.18))) / 10 });
    this.show();
  }

  private changeExposure(): void {
    const value = Number(this.exposure.value);
    this.state.setExposure(this.absolute.value === 'auto' ? { stops: value } : { ev100: value });
    this.show();
  }

  private reset(): void {
    this.state.applyPreset({ name: '', settings: [], others: '', exposure: 'auto', ev100: '', tone: 'agx', camera: '' });
    this.state.faders = this.state.faders.map(() => kPlain);
    this.show();
  }

  private async copy(button: HTMLButtonElement): Promise<void> {
    const { settings, exposure, ev100, tone } = this.state.shared;
    const quoted = (word: string) => (/^[\w.,:#+%=-]+$/.test(word) ? word : `'${word}'`);
    const words = Object.entries(settings).map(([name, text]) => quoted(`${name}=${text}`));
    words.push(ev100 ? `--ev100 ${ev100}` : `--exposure ${exposure}`, `--tone ${tone}`);
    await navigator.clipboard.writeText(words.join(' ')).then(
      () => (button.textContent = 'Copied'),
      () => (button.textContent = 'Not allowed here'),
    );
    setTimeout(() => (button.textContent = 'Copy settings'), 1500);
  }
}
