// SPDX-License-Identifier: Apache-2.0
// Faders shared between windows, where `sconce serve` stands behind the page.

import type { SharedMix, State } from './state';

const kPause = 60; // ms between two messages of this window

export class Live {
  private readonly name = Math.random().toString(36).slice(2);
  private waiting = false;

  /** @param mode of the page's <meta name="sconce-live">: empty = no server, read, write */
  constructor(
    private readonly state: State,
    mode: string,
    onShown: () => void,
  ) {
    if (mode === '') return;
    const events = new EventSource('events');
    events.onmessage = (event) => {
      const mix = JSON.parse(event.data as string) as SharedMix;
      if (mix.from === this.name) return;
      this.state.shared = mix;
      onShown();
    };
    if (mode === 'write') state.onEdit = () => this.send();
  }

  private send(): void {
    if (this.waiting) return;
    this.waiting = true;
    setTimeout(() => {
      this.waiting = false;
      const body = JSON.stringify({ ...this.state.shared, from: this.name });
      fetch('mix', { method: 'PUT', body, headers: { 'content-type': 'application/json' } }).catch(() => {});
    }, kPause);
  }
}
