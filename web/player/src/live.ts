// SPDX-License-Identifier: Apache-2.0
// Faders shared between windows, where `sconce serve` stands behind the page.

import type { SharedMix, State } from './state';

const kPause = 60; // ms between two messages of this window

export class Live {
  private last = '';
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
      if (event.data === this.last) return;
      this.last = event.data as string;
      this.state.shared = JSON.parse(this.last) as SharedMix;
      onShown();
    };
    if (mode === 'write') state.onEdit = () => this.send();
  }

  private send(): void {
    if (this.waiting) return;
    this.waiting = true;
    setTimeout(() => {
      this.waiting = false;
      const text = JSON.stringify(this.state.shared);
      this.last = text;
      fetch('mix', { method: 'PUT', body: text, headers: { 'content-type': 'application/json' } }).catch(() => {});
    }, kPause);
  }
}
