// SPDX-License-Identifier: Apache-2.0
import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  type Camera,
  DataTexture,
  FloatType,
  FrontSide,
  Group,
  type IUniform,
  Matrix3,
  Matrix4,
  Mesh,
  NearestFilter,
  OrthographicCamera,
  PerspectiveCamera,
  RGBAFormat,
  type ShaderMaterial,
  type Texture,
  Vector3,
  WebGLRenderTarget,
  type WebGLRenderer,
} from 'three';

import { autoExposure, ev100Exposure, Meter, type Metering } from './exposure.js';
import { type Arrived, fetchPacked } from './fetch.js';
import { Layers } from './layers.js';
import { LightTarget } from './light_target.js';
import {
  isPane,
  kWhite,
  loadPicture,
  movableMaterial,
  movableShader,
  type Output,
  type Pass,
  skyMaterial,
  skyShader,
  surfaceMaterial,
  surfaceShader,
  type Uniforms,
} from './materials.js';
import { type Pane, panesOf, sortPanes } from './panes.js';
import type { ProbeLight, Probes } from './probes.js';
import { groupWeight, parseSetting, settingsOf } from './setting.js';
import type { LightGroup, Rgb, Site, SitePreset, SiteTier } from './site.js';

/** Stops from automatic, or an absolute exposure value at ISO 100. */
export type ExposureMode = { stops: number } | { ev100: number };

export interface Reading {
  /** Illuminance, lux. */
  lux: number;
  /** Luminance, cd/m². */
  luminance: number;
}

/** The baked scene. Its materials take the mix; whoever draws it draws anew when onChange says so. */
export class Sconce extends Group {
  /** A light changed, or more of it arrived. */
  onChange: () => void = () => {};
  /** Bytes of what is loaded packed. */
  onProgress: (loaded: number, total: number) => void = () => {};
  /** Loading broke off; load() goes on. */
  onError: (error: Error) => void = (error) => console.error(error);

  private readonly settings: string[];
  private readonly weights: Rgb[];
  /** Shared with the materials: as `weights`, as far as layers have arrived. */
  private readonly shown: Vector3[];
  private readonly packed: Vector3[];
  private readonly shared: Uniforms;
  private readonly skies: Texture[] = [];
  private sky?: Mesh<BufferGeometry, ShaderMaterial>;
  private mode: ExposureMode = { stops: 0 };
  private curve = 'agx';
  private pixel?: WebGLRenderTarget;
  /** Where there are panes. */
  private readonly light?: LightTarget;
  private readonly panes: Pane[];
  private readonly sides: Mesh<BufferGeometry, ShaderMaterial[]>[];
  private readonly pictures: IUniform<Texture>[];
  private picturesArrived = false;
  private readonly movables: Mesh<BufferGeometry, ShaderMaterial>[] = [];

  /** Use loadSconce(). */
  constructor(
    readonly site: Site,
    private readonly base: string,
    private readonly mixing: string,
    private readonly kept: Layers,
    private readonly meter: Meter,
    geometry: BufferGeometry,
    private readonly probes: Probes | undefined,
    private readonly output: Output,
    private loaded: number,
    private readonly total: number,
  ) {
    super();
    this.name = site.name;
    this.settings = site.groups.map(() => 'on');
    this.weights = site.groups.map(() => [1, 1, 1]);
    this.shown = site.groups.map(() => new Vector3());
    this.packed = site.groups.map(() => new Vector3());
    this.shared = {
      ...kept.uniforms,
      sconce_weight: { value: this.packed },
      sconce_exposure: { value: 1 },
      sconce_tone: { value: { maximum: 16, adaptation: 0.18, drago_bias: 0.85 } },
      sconce_read: { value: 0 },
    };
    this.pictures = site.textures.map(() => ({ value: kWhite }));
    const material = (batch: Site['geometry']['batches'][number], side: typeof FrontSide | typeof BackSide, pass: Pass) =>
      surfaceMaterial(site, batch, this.pictures, this.shown, this.shared, side, pass);
    this.panes = site.geometry.batches
      .filter((batch) => isPane(site.materials[batch.material]!))
      .flatMap((batch) => panesOf(geometry, batch, (side, pass) => material(batch, side, pass)));
    this.sides = ([FrontSide, BackSide] as const).map(
      (side) => new Mesh(geometry, site.geometry.batches.map((batch) => material(batch, side, 'opaque'))),
    );
    if (this.panes.length > 0) this.add(...this.panes.flatMap((pane) => pane.meshes));
    this.add(...this.sides);
    if (this.panes.length > 0 && output === 'display') this.light = new LightTarget(this.shared.sconce_tone!);
    this.addSky();
    this.writeShaders();
    this.update();
  }

  get groups(): readonly LightGroup[] {
    return this.site.groups;
  }
  get presets(): readonly SitePreset[] {
    return this.site.presets;
  }
  get tier(): SiteTier {
    return this.kept.tier;
  }

  /** Camera of the scene, ready for a picture of this shape. */
  camera(index = 0, aspect = 16 / 9): PerspectiveCamera {
    const from = this.site.cameras[index];
    if (!from) throw new Error(`there is no camera ${index}`);
    const [lo, hi] = this.site.geometry.bounds;
    const size = Math.hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    const camera = new PerspectiveCamera((from.yfov * 180) / Math.PI, aspect, 1.5e-3 * size, 20 * size);
    camera.name = from.name;
    new Matrix4().fromArray(from.matrix).decompose(camera.position, camera.quaternion, camera.scale);
    camera.scale.set(1, 1, 1);
    return camera;
  }

  /** `off`, `on`, `0.5`, `50%`, `+1.5ev`, `800lm`, `2700K`, `color:#rrggbb`, `#rrggbb`, joined by commas. */
  setting(group: number): string {
    return this.settings[group]!;
  }
  /** @throws Error saying what is allowed; nothing has changed then */
  setSettings(texts: readonly string[]): void {
    const weights = this.groups.map((group, g) =>
      groupWeight(group, parseSetting(texts[g] ?? 'on'), this.site.kelvins),
    );
    this.groups.forEach((_, g) => (this.settings[g] = texts[g] ?? 'on'));
    this.setWeights(weights);
  }
  /** Of one group, by name or index. @throws as setSettings() */
  setSetting(group: string | number, text: string): void {
    const index = typeof group === 'number' ? group : this.groups.findIndex((g) => g.name === group);
    if (!this.groups[index]) throw new Error(`unknown light group '${group}'`);
    this.setSettings(this.settings.map((old, g) => (g === index ? text : old)));
  }
  /** Linear RGB weights per group, for those who do their own arithmetic. */
  setWeights(weights: readonly Readonly<Rgb>[]): void {
    weights.forEach((w, g) => (this.weights[g] = [...w]));
    this.update();
  }
  weight(group: number): Readonly<Rgb> {
    return this.weights[group]!;
  }

  /** Settings, exposure and curve of a mood; its camera is the caller's. @throws as setSettings() */
  applyPreset(preset: SitePreset): void {
    this.setSettings(settingsOf(this.site.groups, preset.settings, preset.others));
    if (preset.tone) this.tone = preset.tone;
    if (preset.ev100) this.exposure = { ev100: Number(preset.ev100) };
    else this.exposure = { stops: preset.exposure === 'auto' ? 0 : Number(preset.exposure) };
  }

  get exposure(): ExposureMode {
    return this.mode;
  }
  set exposure(mode: ExposureMode) {
    this.mode = mode;
    this.update();
  }

  /** Name of the tone curve. */
  get tone(): string {
    return this.curve;
  }
  set tone(name: string) {
    if (!this.site.tones.some((tone) => tone.name === name))
      throw new Error(`unknown tone curve '${name}' (allowed: ${this.site.tones.map((t) => t.name).join(', ')})`);
    if (name === this.curve) return;
    this.curve = name;
    this.writeShaders();
    this.onChange();
  }

  /** What exposure is metered on: the light in the scene, wherever the camera is. */
  metering(): Metering {
    return this.meter.measure(this.weights);
  }

  /**
   * Loads what has not arrived yet: pictures, skies, layers.
   * @throws Error in words for people; what arrived stays, and another call goes on
   */
  async load(signal?: AbortSignal): Promise<void> {
    const arrived: Arrived = (bytes) => this.onProgress((this.loaded += bytes), this.total);
    await Promise.all([
      this.loadPictures(signal),
      this.loadSkies(arrived, signal),
      this.kept.load(arrived, () => this.update(), signal),
    ]);
  }

  /**
   * Draws it onto the canvas. As renderer.render(), but what is behind panes is mixed with them as light, where the device
   * draws into halves; codes are mixed otherwise.
   */
  render(renderer: WebGLRenderer, camera: Camera): void {
    if (!this.light || renderer.getRenderTarget() || !LightTarget.works(renderer)) return renderer.render(this, camera);
    sortPanes(this.panes, this.worldToLocal(camera.getWorldPosition(new Vector3())));
    this.shared.sconce_read!.value = 3;
    this.light.draw(renderer, this, camera);
    this.shared.sconce_read!.value = 0;
  }

  /** Light at a point of the picture, x and y in [0,1] from the top left; nothing where the device cannot tell. */
  read(renderer: WebGLRenderer, camera: PerspectiveCamera | OrthographicCamera, x: number, y: number): Reading | undefined {
    if (!renderer.extensions.has('EXT_color_buffer_float')) return undefined;
    this.pixel ??= new WebGLRenderTarget(1, 1, { format: RGBAFormat, type: FloatType, magFilter: NearestFilter, minFilter: NearestFilter });
    const looking = camera.clone() as PerspectiveCamera;
    const kGrid = 8192;
    looking.setViewOffset(kGrid, kGrid, Math.floor(x * kGrid), Math.floor(y * kGrid), 1, 1);
    const lux = this.readPixel(renderer, looking, 1);
    const luminance = this.readPixel(renderer, looking, 2);
    return { lux, luminance };
  }

  /** Has the package probes (bake --probes)? */
  get hasProbes(): boolean {
    return this.probes !== undefined;
  }
  /**
   * Light at a place, mixed as the faders are: what faces the unit n there receives max(0, e + g · n), and shows
   * albedo · E / π cd/m².
   * @throws Error without probes
   */
  probeLight(at: Vector3): ProbeLight {
    if (!this.probes) throw new Error('this package has no probes (sconce bake --probes 1)');
    return this.probes.mixed([at.x, at.y, at.z], this.weights);
  }
  /**
   * A diffuse thing in the light of the probes around its middle; it follows the faders wherever it is moved to.
   * @param albedo linear Rec. 709
   * @throws Error without probes
   */
  movable(geometry: BufferGeometry, albedo: Readonly<Rgb>): Mesh {
    const light = [0, 1, 2, 3].map(() => new Vector3());
    this.probeLight(light[0]!);
    const material = movableMaterial({
      ...this.shared,
      albedo: { value: new Vector3(...albedo) },
      sconce_probe: { value: light },
    });
    const mesh = new Mesh(geometry, material);
    const at = new Vector3();
    mesh.onBeforeRender = () => {
      this.probeLight(at.setFromMatrixPosition(mesh.matrixWorld)).forEach((k, i) => light[i]!.set(...k));
      material.uniformsNeedUpdate = true;
    };
    this.movables.push(mesh);
    this.add(mesh);
    this.writeShaders();
    return mesh;
  }

  /** Frees what the graphics device holds. */
  dispose(): void {
    this.kept.dispose();
    for (const { geometry } of [...this.sides, ...this.panes.flatMap((pane) => pane.meshes)]) geometry.dispose();
    for (const material of this.surfaces()) material.dispose();
    for (const { geometry, material } of this.movables) geometry.dispose(), material.dispose();
    for (const texture of [...this.pictures.map((p) => p.value), ...this.skies]) texture.dispose();
    this.sky?.geometry.dispose();
    this.sky?.material.dispose();
    this.pixel?.dispose();
    this.light?.dispose();
  }

  private surfaces(): ShaderMaterial[] {
    return [...this.sides.flatMap((mesh) => mesh.material), ...this.panes.flatMap((pane) => pane.meshes.map((mesh) => mesh.material))];
  }

  private readPixel(renderer: WebGLRenderer, camera: Camera, what: number): number {
    const before = renderer.getRenderTarget();
    const rgba = new Float32Array(4);
    this.shared.sconce_read!.value = what;
    renderer.setRenderTarget(this.pixel!);
    renderer.render(this, camera);
    renderer.readRenderTargetPixels(this.pixel!, 0, 0, 1, 1, rgba);
    renderer.setRenderTarget(before);
    this.shared.sconce_read!.value = 0;
    return 0.2126 * rgba[0]! + 0.7152 * rgba[1]! + 0.0722 * rgba[2]!;
  }

  private update(): void {
    const { colors } = this.kept.tier;
    this.weights.forEach((w, g) => {
      const there = this.kept.arrived[g] ? 1 : 0;
      this.shown[g]!.set(...w);
      this.packed[g]!.set(w[0] * colors[g]![0] * there, w[1] * colors[g]![1] * there, w[2] * colors[g]![2] * there);
    });
    const metering = this.metering();
    const exposure =
      'ev100' in this.mode ? ev100Exposure(this.mode.ev100, metering) : autoExposure(metering, this.mode.stops);
    this.shared.sconce_exposure!.value = exposure.scale;
    this.shared.sconce_tone!.value.maximum = exposure.maximum;
    this.onChange();
  }

  private writeShaders(): void {
    const tone = this.site.tones.find((t) => t.name === this.curve)!.glsl;
    this.light?.setTone(tone);
    const text = surfaceShader(this.site, this.mixing, tone, this.output);
    for (const material of this.surfaces()) {
      material.fragmentShader = text;
      material.needsUpdate = true;
    }
    for (const { material } of this.movables) {
      material.fragmentShader = movableShader(tone, this.output);
      material.needsUpdate = true;
    }
    if (!this.sky) return;
    this.sky.material.fragmentShader = skyShader(this.site.skies.length, tone, this.output);
    this.sky.material.needsUpdate = true;
  }

  private addSky(): void {
    if (this.site.skies.length === 0) return;
    const uniforms: Uniforms = { ...this.shared };
    this.site.skies.forEach((sky, i) => {
      const texture = new DataTexture(new Uint8Array(4), 1, 1);
      texture.needsUpdate = true;
      this.skies.push(texture);
      uniforms[`sky_${i}`] = { value: texture };
      uniforms[`sky_scale_${i}`] = { value: new Vector3(...sky.scale) };
      uniforms[`sky_weight_${i}`] = { value: this.shown[sky.group] ?? new Vector3(1, 1, 1) };
      uniforms[`sky_frame_${i}`] = { value: new Matrix3().fromArray(sky.axes) };
    });
    const triangle = new BufferGeometry();
    triangle.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    this.sky = new Mesh(triangle, skyMaterial(uniforms));
    this.sky.frustumCulled = false;
    this.sky.raycast = () => {};
    this.add(this.sky);
  }

  private async loadSkies(arrived: Arrived, signal?: AbortSignal): Promise<void> {
    await Promise.all(
      this.site.skies.map(async (sky, i) => {
        const texture = this.skies[i]!;
        if (texture.userData.arrived) return;
        const data = new Uint8Array(await fetchPacked(this.base + sky.file, 4, arrived, signal));
        texture.dispose();
        texture.image = { data, width: sky.width, height: sky.height };
        texture.userData.arrived = texture.needsUpdate = true;
        this.onChange();
      }),
    );
  }

  private async loadPictures(signal?: AbortSignal): Promise<void> {
    if (this.picturesArrived) return;
    await Promise.all(
      this.site.textures.map(async ({ file }, i) => {
        if (file) this.pictures[i]!.value = await loadPicture(this.site, i, this.base, signal);
      }),
    );
    this.picturesArrived = true;
    this.onChange();
  }
}
