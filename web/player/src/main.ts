// SPDX-License-Identifier: Apache-2.0
// The page that `sconce export --web` and `sconce serve` show. ?tier=NAME chooses layers, ?panel=off leaves the picture
// alone, ?ball=X,Y,Z[,RADIUS] puts a ball into the light of the package's probes.

import { loadSconce, type Sconce } from 'sconce-three';
import { SphereGeometry, WebGLRenderer } from 'three';

import { byId, element } from './dom';
import { Live } from './live';
import { Look } from './look';
import { Panel } from './panel';
import { State } from './state';

const query = new URLSearchParams(location.search);
const canvas = byId<HTMLCanvasElement>('view');
const notice = byId('notice');
const progress = byId('progress');
const reading = byId<HTMLOutputElement>('reading');

/** For people and tests: loading, ready, or failed. */
function setState(state: string): void {
  document.documentElement.dataset.state = state;
}

function complain(title: string, text: string, again?: () => void): void {
  notice.replaceChildren(element('h2', {}, title), element('p', {}, text));
  if (again) {
    const button = element('button', { type: 'button' }, 'Try again');
    button.addEventListener('click', again);
    notice.append(button);
  }
  notice.hidden = false;
  setState('failed');
}

function showProgress(loaded: number, total: number): void {
  const percent = Math.min(100, Math.round((100 * loaded) / Math.max(total, 1)));
  progress.setAttribute('aria-valuenow', String(percent));
  progress.style.setProperty('--done', `${percent}%`);
}

/** Whatever arrived stays. */
async function loadAll(sconce: Sconce): Promise<void> {
  notice.hidden = true;
  progress.hidden = false;
  setState('loading');
  try {
    await sconce.load();
    progress.hidden = true;
    setState('ready');
  } catch (error) {
    complain('Some of the light did not arrive', (error as Error).message, () => void loadAll(sconce));
  }
}

function number(value: number): string {
  return value >= 1000 ? Math.round(value).toLocaleString('en') : value >= 100 ? value.toFixed(0) : value.toPrecision(2);
}

class Reader {
  constructor(
    private readonly sconce: Sconce,
    private readonly renderer: WebGLRenderer,
    private readonly look: Look,
  ) {
    let asked = false;
    canvas.addEventListener('pointermove', (event) => {
      if (event.buttons !== 0 && event.pointerType === 'mouse') return this.hide();
      if (asked) return;
      asked = true;
      requestAnimationFrame(() => {
        asked = false;
        this.show(event.clientX, event.clientY);
      });
    });
    canvas.addEventListener('pointerdown', (event) => {
      if (event.pointerType !== 'mouse') this.show(event.clientX, event.clientY);
    });
    canvas.addEventListener('pointerleave', () => this.hide());
    canvas.addEventListener('keydown', (event) => {
      if (event.key.toLowerCase() !== 'r' || event.ctrlKey || event.metaKey) return;
      const text = this.show(canvas.clientWidth / 2, canvas.clientHeight / 2);
      byId('spoken').textContent = `In the middle: ${text}`;
    });
  }

  private hide(): void {
    reading.hidden = true;
  }

  private show(x: number, y: number): string {
    const seen = this.sconce.read(this.renderer, this.look.camera, x / canvas.clientWidth, y / canvas.clientHeight);
    if (!seen) return '';
    const text = `${number(seen.lux)} lx · ${number(seen.luminance)} cd/m²`;
    reading.textContent = text;
    reading.hidden = false;
    const right = x > canvas.clientWidth - 180;
    reading.style.transform = `translate(${x + (right ? -14 : 14)}px, ${y + 14}px)${right ? ' translateX(-100%)' : ''}`;
    return text;
  }
}

function makeRenderer(): WebGLRenderer | undefined {
  // Asked for beforehand: three.js would write to the console.
  if (!document.createElement('canvas').getContext('webgl2')) return undefined;
  return new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
}

const narrow = matchMedia('(max-width: 640px)');

/** Of the window's lower end, in CSS pixels: on phones the picture stands above the open panel, not behind it. */
function coveredHeight(): number {
  return narrow.matches && !document.body.classList.contains('folded') ? byId('panel').offsetHeight : 0;
}

function foldable(): void {
  const fold = byId<HTMLButtonElement>('fold');
  const set = (open: boolean) => {
    document.body.classList.toggle('folded', !open);
    fold.setAttribute('aria-expanded', String(open));
    byId('panel').inert = !open;
    dispatchEvent(new Event('resize')); // of what is left for the picture
  };
  fold.addEventListener('click', () => set(document.body.classList.contains('folded')));
  document.addEventListener('keydown', (event) => {
    const typing = event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement;
    if (event.key.toLowerCase() === 'h' && !typing && !event.ctrlKey && !event.metaKey) fold.click();
  });
  if (query.get('panel') === 'off') document.body.classList.add('bare');
  set(query.get('panel') !== 'off' && !narrow.matches);
}

async function start(): Promise<void> {
  setState('loading');
  foldable();
  const renderer = makeRenderer();
  if (!renderer)
    return complain('This page needs WebGL 2', 'Your browser does not offer it, or it is switched off. Any current browser with graphics acceleration does.');
  const tier = query.get('tier') ?? undefined;
  const sconce = await loadSconce('scene', { ...(tier ? { tier } : {}), lazy: true, onProgress: showProgress });
  document.title = sconce.name || 'sconce';

  const ball = query.get('ball')?.split(',').map(Number);
  if (ball?.every(Number.isFinite) && ball.length >= 3 && sconce.hasProbes)
    sconce.movable(new SphereGeometry(ball[3] ?? 0.1, 48, 24), [0.8, 0.8, 0.8]).position.set(ball[0]!, ball[1]!, ball[2]!);

  const look = new Look(sconce, canvas);
  const state = new State(sconce);
  const panel = new Panel(byId('panel'), state, look);
  state.onShow = () => panel.show();

  let dirty = false;
  const draw = () => {
    if (dirty) return;
    dirty = true;
    requestAnimationFrame(() => {
      dirty = false;
      sconce.render(renderer, look.camera);
    });
  };
  sconce.onChange = look.onChange = draw;
  const resize = () => {
    const height = innerHeight - coveredHeight();
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(innerWidth, height, true);
    look.resize(innerWidth / height);
  };
  addEventListener('resize', resize);
  resize();
  new Reader(sconce, renderer, look);
  const live = document.querySelector<HTMLMetaElement>('meta[name=sconce-live]')?.content ?? '';
  // Where nobody else moves faders the first mood is what is seen first.
  if (live === '' && sconce.presets[0]) panel.start(sconce.presets[0]);
  new Live(state, live, () => panel.show());
  await loadAll(sconce);
}

start().catch((error: unknown) =>
  complain('The scene did not arrive', error instanceof Error ? error.message : String(error), () => location.reload()),
);
