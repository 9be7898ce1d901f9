// SPDX-License-Identifier: Apache-2.0
// node three_shaders.mjs FOLDER: writes the vertex shaders that three.js hands to WebGL, as they are handed over, for its
// materials with and without what changes their shaders. There is no WebGL: a context that agrees to everything listens.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

import * as THREE from 'three';

const sources = new Set();
const answers = {
  getExtension: () => ({}),
  getContextAttributes: () => ({}),
  getShaderPrecisionFormat: () => ({ precision: 23 }),
  getSupportedExtensions: () => [],
  getShaderInfoLog: () => '',
  getProgramInfoLog: () => '',
  createShader: (type) => ({ type }),
  isContextLost: () => false,
};
const gl = new Proxy({}, {
  get: (_, name) => {
    if (name === 'shaderSource') return ({ type }, text) => type === 'VERTEX_SHADER' && sources.add(text);
    if (name === 'getParameter')
      return (what) => (what === 'VERSION' ? 'WebGL 2.0' : /VIEWPORT|SCISSOR_BOX/.test(what) ? [0, 0, 1, 1] : 16);
    if (name === 'getProgramParameter') return (_program, what) => (what === 'LINK_STATUS' ? true : 0);
    if (answers[name]) return answers[name];
    return /^[A-Z0-9_]+$/.test(name) ? name : () => ({});
  },
});
const canvas = { width: 1, height: 1, style: {}, addEventListener() {}, removeEventListener() {}, getContext: () => gl };
globalThis.WebGLRenderingContext = class {};
globalThis.self ??= globalThis;
const renderer = new THREE.WebGLRenderer({ canvas, context: gl });
renderer.shadowMap.enabled = true;

const box = new THREE.BoxGeometry();
box.setAttribute('uv1', box.attributes.uv);
box.setAttribute('tangent', new THREE.BufferAttribute(new Float32Array(96), 4));
box.setAttribute('color', new THREE.BufferAttribute(new Float32Array(72), 3));
box.setAttribute('skinIndex', new THREE.BufferAttribute(new Uint16Array(96), 4));
box.setAttribute('skinWeight', new THREE.BufferAttribute(new Float32Array(96), 4));
const morphing = box.clone();
morphing.morphAttributes = { position: [box.attributes.position], normal: [box.attributes.normal] };
const texture = new THREE.DataTexture(new Uint8Array(4), 1, 1);
const lightMap = new THREE.DataTexture(new Uint8Array(4), 1, 1);
lightMap.channel = 1;

const lights = [new THREE.DirectionalLight(), new THREE.PointLight(), new THREE.SpotLight(), new THREE.HemisphereLight()];
for (const light of lights.slice(0, 3)) light.castShadow = true;

const kinds = ['Basic', 'Lambert', 'Phong', 'Toon', 'Standard', 'Physical', 'Matcap', 'Normal', 'Depth', 'Distance'].map((kind) => THREE[`Mesh${kind}Material`]);
const looks = [
  {}, { map: texture }, { lightMap }, { normalMap: texture, displacementMap: texture }, { vertexColors: true }, { flatShading: true },
  { alphaMap: texture, alphaTest: 0.5 }, { transmission: 0.5, thicknessMap: texture, iridescence: 1, sheen: 1, clearcoat: 1, clearcoatNormalMap: texture },
];
const bodies = [
  (material) => new THREE.Mesh(box, material),
  (material) => new THREE.Mesh(morphing, material),
  (material) => new THREE.InstancedMesh(box, material, 3),
  (material) => {
    const mesh = new THREE.SkinnedMesh(box, material);
    mesh.bind(new THREE.Skeleton([new THREE.Bone()]));
    return mesh;
  },
];

for (const lit of [false, true])
  for (const fog of [null, new THREE.Fog(0)])
    for (const Kind of kinds)
      for (const look of looks)
        for (const body of bodies) {
          const scene = new THREE.Scene();
          scene.fog = fog;
          if (lit) scene.add(...lights);
          const material = new Kind();
          if (!Object.keys(look).every((key) => key in material)) continue;
          scene.add(body(Object.assign(material, look)));
          renderer.compile(scene, new THREE.PerspectiveCamera());
        }
for (const object of [
  new THREE.Points(box, new THREE.PointsMaterial()), new THREE.Sprite(new THREE.SpriteMaterial()),
  new THREE.Line(box, new THREE.LineDashedMaterial()), new THREE.Mesh(box, new THREE.ShadowMaterial()),
])
  renderer.compile(new THREE.Scene().add(object), new THREE.PerspectiveCamera());

[...sources].forEach((text, i) => writeFileSync(join(process.argv[2], `${i}.vert`), text));
console.log(sources.size);
