// SPDX-License-Identifier: Apache-2.0
// Light that is blended before it is tone mapped: what panes need, and codes cannot do.

import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  GLSL3,
  HalfFloatType,
  Mesh,
  NearestFilter,
  type Object3D,
  Scene,
  ShaderMaterial,
  Vector2,
  WebGLRenderTarget,
  type WebGLRenderer,
} from 'three';

import type { Uniforms } from './materials.js';

const kSamples = 4; // per pixel, as browsers take for a canvas

/** A picture of exposed light in halves, and the pass that turns it into codes. */
export class LightTarget {
  private readonly target = new WebGLRenderTarget(1, 1, {
    type: HalfFloatType,
    minFilter: NearestFilter,
    magFilter: NearestFilter,
    samples: kSamples,
  });
  private readonly size = new Vector2();
  private readonly screen = new Scene();
  private readonly triangle: Mesh<BufferGeometry, ShaderMaterial>;

  /** @param tone `sconce_tone`, shared with the materials */
  constructor(tone: Uniforms[string]) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const material = new ShaderMaterial({
      name: 'tone',
      glslVersion: GLSL3,
      vertexShader: 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
      depthTest: false,
      depthWrite: false,
      uniforms: { light: { value: this.target.texture }, sconce_tone: tone },
    });
    this.triangle = new Mesh(geometry, material);
    this.triangle.frustumCulled = false;
    this.screen.add(this.triangle);
  }

  /** Whether this device draws into halves. */
  static works(renderer: WebGLRenderer): boolean {
    return renderer.extensions.has('EXT_color_buffer_float') || renderer.extensions.has('EXT_color_buffer_half_float');
  }

  /** @param tone the curve's shader */
  setTone(tone: string): void {
    this.triangle.material.fragmentShader = `out vec4 seen;
uniform sampler2D light;
${tone}
uniform ToneParams sconce_tone;
void main() {
  vec3 exposed = texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb;
  seen = vec4(linear_to_srgb(tone_map(exposed, sconce_tone)), 1.0);
}
`;
    this.triangle.material.needsUpdate = true;
  }

  /** Draws onto the canvas. @param scene whose materials give exposed light now */
  draw(renderer: WebGLRenderer, scene: Object3D, camera: Camera): void {
    renderer.getDrawingBufferSize(this.size);
    this.target.setSize(this.size.x, this.size.y);
    renderer.setRenderTarget(this.target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.screen, camera);
  }

  dispose(): void {
    this.target.dispose();
    this.triangle.geometry.dispose();
    this.triangle.material.dispose();
  }
}
