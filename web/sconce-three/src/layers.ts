// SPDX-License-Identifier: Apache-2.0
// The layers of one tier as textures that fill while they arrive; black until then.

import {
  ClampToEdgeWrapping,
  CompressedArrayTexture,
  CompressedTexture,
  DataArrayTexture,
  DataTexture,
  FloatType,
  HalfFloatType,
  LinearFilter,
  NearestFilter,
  RedFormat,
  RGBAFormat,
  RGB_BPTC_UNSIGNED_Format,
  RGFormat,
  type Texture,
  UnsignedByteType,
} from 'three';

import { type Arrived, fetchPacked } from './fetch.js';
import type { LayerTexture, Sampler, Site, SiteTier } from './site.js';

type Texels = Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer> | Float32Array<ArrayBuffer>;

const kTypes = { f32: FloatType, f16: HalfFloatType, u8: UnsignedByteType, bc6h: UnsignedByteType };
const kBytes = { f32: 4, f16: 2, u8: 1, bc6h: 1 };

function makeTexels(type: LayerTexture['type'], from: ArrayBuffer | number): Texels {
  const Kind = type === 'f32' ? Float32Array : type === 'f16' ? Uint16Array : Uint8Array;
  return new Kind(from as number) as Texels;
}

function widen(texels: Texels, type: LayerTexture['type'], from: number, to: number): Texels {
  if (from === to || type === 'bc6h') return texels;
  const out = makeTexels(type, (texels.length / from) * to);
  for (let i = 0, o = 0; i < texels.length; o += to - from) for (let c = 0; c < from; ++c) out[o++] = texels[i++]!;
  return out;
}

const formatOf = (channels: number) => (channels === 1 ? RedFormat : channels === 2 ? RGFormat : RGBAFormat);

export class Layers {
  /** By the sampler's name, for ShaderMaterial.uniforms. */
  readonly uniforms: Record<string, { value: Texture }> = {};
  /** Per group: its illuminance has arrived. */
  readonly arrived: boolean[];
  /** Per texture. */
  private readonly whole: boolean[];

  constructor(
    private readonly site: Site,
    readonly tier: SiteTier,
    private readonly base: string,
  ) {
    this.arrived = site.groups.map(() => false);
    this.whole = tier.textures.map(() => false);
    for (const sampler of tier.samplers)
      this.uniforms[sampler.name] = { value: sampler.array ? this.emptyArray(sampler) : this.texture(sampler, 1, 1) };
  }

  /**
   * What has not arrived yet, brightest first, normal maps' share last; onLayer after each.
   * @throws Error in words for people; what arrived stays
   */
  async load(arrived: Arrived, onLayer: () => void, signal?: AbortSignal): Promise<void> {
    const lux = (t: LayerTexture) => Math.max(...t.groups.map((g) => this.site.groups[g]!.meanLux));
    const left = this.tier.textures
      .map((layout, index) => ({ layout, index }))
      .filter(({ index }) => !this.whole[index])
      .sort((a, b) => a.layout.coefficient - b.layout.coefficient || lux(b.layout) - lux(a.layout));
    const work = async () => {
      for (let next = left.shift(); next; next = left.shift()) {
        const { layout, index } = next;
        for (let page = 0; page < layout.pages.length; ++page) await this.loadPage(layout, index, page, arrived, signal);
        this.whole[index] = true;
        if (layout.coefficient === 0) for (const g of layout.groups) this.arrived[g] = true;
        onLayer();
      }
    };
    await Promise.all([work(), work(), work()]);
  }

  dispose(): void {
    for (const { value } of Object.values(this.uniforms)) value.dispose();
  }

  private async loadPage(layout: LayerTexture, index: number, page: number, arrived: Arrived, signal?: AbortSignal) {
    const element = layout.type === 'bc6h' ? 16 : kBytes[layout.type] * layout.channels;
    const data = await fetchPacked(this.base + layout.pages[page]!.file, element, arrived, signal);
    const { width, height } = this.site.atlas;
    const expected =
      layout.type === 'bc6h'
        ? 16 * Math.ceil(width / 4) * Math.ceil(height / 4) * layout.planes
        : element * width * height * layout.planes;
    if (data.byteLength !== expected) throw new Error(`${layout.pages[page]!.file} is of another size than it says`);
    for (let plane = 0; plane < layout.planes; ++plane) {
      const part = data.slice((plane * expected) / layout.planes, ((plane + 1) * expected) / layout.planes);
      this.put(index, plane, page, makeTexels(layout.type, part));
    }
  }

  private put(index: number, plane: number, page: number, stored: Texels): void {
    const { type, channels } = this.tier.textures[index]!;
    for (const sampler of this.tier.samplers) {
      const slice = sampler.slices.findIndex(
        (s) => s.texture === index && s.plane === plane && (!sampler.array || s.page === page),
      );
      if (slice < 0) continue;
      const uniform = this.uniforms[sampler.name]!;
      const texels = widen(stored, type, channels, this.channelsOf(sampler));
      if (!sampler.array) {
        uniform.value.dispose();
        uniform.value = this.texture(sampler, this.site.atlas.width, this.site.atlas.height, texels);
        continue;
      }
      const array = uniform.value as DataArrayTexture | CompressedArrayTexture;
      const whole =
        array instanceof CompressedArrayTexture ? (array.mipmaps![0] as { data: Texels }).data : (array.image.data as Texels);
      whole.set(texels, slice * texels.length);
      array.addLayerUpdate(slice);
      array.needsUpdate = true;
    }
  }

  /** Of the textures of a sampler; three.js offers none of three channels. */
  private channelsOf(sampler: Sampler): number {
    const most = Math.max(...sampler.slices.map((s) => this.tier.textures[s.texture]!.channels));
    return most === 3 ? 4 : most;
  }

  private layoutOf(sampler: Sampler): LayerTexture {
    return this.tier.textures[sampler.slices[0]!.texture]!;
  }

  private texture(sampler: Sampler, width: number, height: number, texels?: Texels): Texture {
    const { type } = this.layoutOf(sampler);
    const held = this.channelsOf(sampler);
    if (type === 'bc6h') {
      const block = { data: (texels ?? new Uint8Array(16)) as Uint8Array<ArrayBuffer>, width: texels ? width : 4, height: texels ? height : 4 };
      return this.finish(new CompressedTexture([block], block.width, block.height, RGB_BPTC_UNSIGNED_Format), sampler);
    }
    const data = texels ?? makeTexels(type, held * width * height);
    return this.finish(new DataTexture(data, width, height, formatOf(held), kTypes[type]), sampler);
  }

  private emptyArray(sampler: Sampler): Texture {
    const { width, height } = this.site.atlas;
    const { type } = this.layoutOf(sampler);
    const depth = sampler.slices.length;
    if (type === 'bc6h') {
      const data = new Uint8Array(16 * Math.ceil(width / 4) * Math.ceil(height / 4) * depth);
      return this.finish(
        new CompressedArrayTexture([{ data, width, height }], width, height, depth, RGB_BPTC_UNSIGNED_Format),
        sampler,
      );
    }
    const held = this.channelsOf(sampler);
    const array = new DataArrayTexture(makeTexels(type, held * width * height * depth), width, height, depth);
    array.format = formatOf(held);
    array.type = kTypes[type];
    return this.finish(array, sampler);
  }

  private finish<T extends Texture>(texture: T, sampler: Sampler): T {
    texture.magFilter = texture.minFilter = sampler.linear ? LinearFilter : NearestFilter;
    texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
    texture.generateMipmaps = false;
    texture.flipY = false;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    return texture;
  }
}
