// SPDX-License-Identifier: Apache-2.0
// Global illumination for a three.js program: all that stands between the two in the page. sconce runs beside it on the
// same machine (src/web/radiosity_service.h). The program's materials, shaders and lights are its own.
import * as THREE from 'three';

/** @returns the message as radiosity_message.h has it */
function pack(head, ...arrays) {
  const json = new TextEncoder().encode(JSON.stringify(head));
  const padded = new Uint8Array(4 + 4 * Math.ceil(json.length / 4)).fill(32);
  new DataView(padded.buffer).setUint32(0, padded.length - 4, true);
  padded.set(json, 4);
  return new Blob([padded, ...arrays]);
}

function unpack(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const json = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  return { ...JSON.parse(json), floats: new Float32Array(buffer, 4 + length) };
}

/** Calls f while objects have other values. @param changes  [object, key, value] */
function having(changes, f) {
  const kept = changes.map(([object, key]) => object[key]);
  try {
    for (const [object, key, value] of changes) object[key] = value;
    return f();
  } finally {
    changes.forEach(([object, key], i) => (object[key] = kept[i]));
  }
}

export class ThreeRadiosity {
  #renderer; #scene; #camera; #service;
  #parts = []; // {mesh, places}
  #materials = new Map(); // the program's, with their numbers
  #rewritten = new Map(); // vertex shaders, by the program's text
  #pending = new Map(); // those not yet rewritten, with their names
  #compiled = 0; // how often the program's shaders had to be compiled again
  #inFaces = { value: 0 };
  #last = Promise.resolve(); // conversation
  #white = new THREE.MeshLambertMaterial({ color: 'white', name: 'white card' });
  #probe = new THREE.DirectionalLight();
  #eye = new THREE.PerspectiveCamera();
  #target = new THREE.WebGLRenderTarget(1, 1, { type: THREE.FloatType, depthBuffer: false, magFilter: THREE.NearestFilter, minFilter: THREE.NearestFilter });
  ambient; // texture, linear: what surfaces of reflectance 1 show of it
  found; // {materials: [{name, reflectance, emission, transmission, residual}], findings}

  /** Takes the visible meshes in: every corner of a face gets a vertex of its own, with its place in the ambient map as
      uv1. Materials that know light maps show it. @param camera  the program's
      @throws Error  a mesh or shader that cannot be taken, or a fault of the renderer: one line; the program goes on */
  static async start(renderer, scene, camera, { service = 'sconce/', density = 12 } = {}) {
    const made = new ThreeRadiosity();
    Object.assign(made, { ambient: null, found: null });
    made.#renderer = renderer;
    made.#scene = scene;
    made.#camera = camera;
    made.#service = service;
    await made.#start(density);
    return made;
  }

  async #start(density) {
    if (!this.#renderer.getContext().getExtension('EXT_color_buffer_float')) throw new Error('WebGL: cannot draw to floats');
    this.#probe.visible = false;
    this.#scene.add(this.#probe, this.#probe.target);
    this.#hook(this.#white);
    const geometry = this.#collect();
    await this.#rewrite(() => this.#renderer.compile(this.#scene, this.#camera));
    const map = await this.#post('start', pack({ ...geometry.head, density }, ...geometry.arrays));
    let at = 0;
    for (const { mesh } of this.#parts) {
      const size = 2 * mesh.geometry.attributes.position.count;
      mesh.geometry.setAttribute('uv1', new THREE.BufferAttribute(map.floats.slice(at, at + size), 2));
      at += size;
    }
    this.ambient = new THREE.DataTexture(new Float32Array(4 * map.width * map.height), map.width, map.height, THREE.RGBAFormat, THREE.FloatType);
    Object.assign(this.ambient, { channel: 1, magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter, needsUpdate: true });
    await this.#find('begin');
    for (const material of this.#materials.keys())
      if ('lightMap' in material) Object.assign(material, { lightMap: this.ambient, lightMapIntensity: Math.PI, needsUpdate: true });
  }

  /** Looks at the materials again, after the program changed them. @throws Error  then the old ones stay */
  detect() {
    return this.#find('detect');
  }

  async #find(kind) {
    const { materials, findings } = await this.#converse({ kind });
    const names = [...this.#materials.keys()].map((m) => m.name);
    this.found = { materials: materials.map((m, i) => ({ name: names[i], ...m })), findings };
  }

  /** Reads the direct light and brings the ambient map up to date.
      @returns {fault, drawn, read, solved}  one line, or '': then the map is black; milliseconds in the page, of them reading back, in
      sconce */
  async update() {
    let frame;
    try {
      frame = await this.#converse({ kind: 'update' });
    } catch (error) {
      frame = { fault: error.message, floats: new Float32Array(this.ambient.image.data.length) };
    }
    this.ambient.image.data.set(frame.floats);
    this.ambient.needsUpdate = true;
    return frame;
  }

  /** Draws what sconce asks for until it says what came of it; one conversation after the other. */
  #converse(message) {
    const all = this.#last.then(() => this.#talk(message));
    this.#last = all.catch(() => {});
    return all;
  }

  async #talk(message) {
    let reply = await this.#post('turn', pack(message));
    while (reply.kind === 'draw') {
      let answer;
      try {
        answer = await this.#answer(reply);
      } catch (error) {
        answer = pack({ kind: 'drawn', fault: error.message });
      }
      reply = await this.#post('turn', answer);
    }
    if (reply.kind === 'failed') throw new Error(reply.message);
    return reply;
  }

  async #post(what, body) {
    const response = await fetch(this.#service + what, { method: 'POST', body });
    if (!response.ok) throw new Error(await response.text());
    return what.startsWith('override') ? response.text() : unpack(await response.arrayBuffer());
  }

  #collect() {
    const meshes = [], positions = [], normals = [];
    this.#scene.updateMatrixWorld(true);
    this.#scene.traverseVisible((mesh) => {
      if (!mesh.isMesh) return;
      const old = mesh.geometry, { material } = mesh;
      if (mesh.isSkinnedMesh || mesh.isInstancedMesh || mesh.isBatchedMesh || Array.isArray(material) || material.lightMap || !old.attributes.normal || old.attributes.uv1)
        throw new Error(`${mesh.name || 'a mesh'}: cannot be taken (allowed: still meshes with normals, one material, no light map)`);
      mesh.geometry = old.index ? old.toNonIndexed() : old.clone();
      const { position, normal } = mesh.geometry.attributes;
      const places = new THREE.BufferAttribute(new Float32Array(2 * position.count), 2).setUsage(THREE.DynamicDrawUsage);
      mesh.geometry.setAttribute('sconce_place', places);
      this.#parts.push({ mesh, places });
      if (!this.#materials.has(material)) {
        this.#materials.set(material, this.#materials.size);
        this.#hook(material);
      }
      meshes.push({ vertices: position.count, material: this.#materials.get(material) });
      positions.push(position.clone().applyMatrix4(mesh.matrixWorld).array);
      normals.push(normal.clone().applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(mesh.matrixWorld)).array);
    });
    return { head: { meshes, materials: [...this.#materials.keys()].map((m) => m.name) }, arrays: [...positions, ...normals] };
  }

  /** The material's vertex shaders, whatever the program makes of them and when, end with the position override. */
  #hook(material) {
    let own = material.onBeforeCompile;
    let key = Object.hasOwn(material, 'customProgramCacheKey') ? material.customProgramCacheKey : () => own.toString();
    const hooked = (shader, renderer) => {
      own.call(material, shader, renderer);
      const ours = this.#rewritten.get(shader.vertexShader);
      if (ours === undefined) this.#pending.set(shader.vertexShader, material);
      shader.vertexShader = ours ?? shader.vertexShader;
      shader.uniforms.sconce_in_faces = this.#inFaces;
    };
    Object.defineProperty(material, 'onBeforeCompile', { get: () => hooked, set: (f) => (own = f) });
    Object.defineProperty(material, 'customProgramCacheKey', {
      get: () => () => `${key.call(material)} sconce ${this.#compiled}`,
      set: (f) => (key = f),
    });
  }

  /** Calls f, which compiles shaders, until all of them are rewritten. */
  async #rewrite(f) {
    f();
    while (this.#pending.size > 0) {
      const pending = [...this.#pending];
      this.#pending.clear();
      ++this.#compiled; // also those that are refused: each drawing asks for them again
      for (const each of [...this.#materials.keys(), this.#white]) each.needsUpdate = true;
      for (const [text, { name, type }] of pending) {
        const ours = await this.#post(`override?name=${encodeURIComponent(name || type)}`, text);
        this.#rewritten.set(text, ours);
      }
      f();
    }
  }

  async #answer(request) {
    let at = 0;
    for (const { places } of this.#parts) {
      if (request.floats.length === 0) break; // as before
      places.array.set(request.floats.subarray(at, at + places.array.length));
      places.needsUpdate = true;
      at += places.array.length;
    }
    this.#target.setSize(request.width, request.height);
    await this.#rewrite(() => this.#draw(request));
    const values = new Float32Array(4 * request.width * request.height), before = performance.now();
    this.#renderer.readRenderTargetPixels(this.#target, 0, 0, request.width, request.height, values);
    if (this.#renderer.getContext().isContextLost()) throw new Error('the WebGL context is lost');
    return pack({ kind: 'drawn', width: request.width, height: request.height, read: performance.now() - before }, values);
  }

  #draw({ lights, to_light, intensity, eye, white_card, background }) {
    const renderer = this.#renderer, scene = this.#scene, taken = new Set(this.#parts.map(({ mesh }) => mesh));
    const changes = [
      [this.#inFaces, 'value', 1], [this.#probe, 'visible', lights === 'probe'], [this.#probe, 'intensity', intensity],
      [scene, 'background', null], [scene, 'environment', null], [scene, 'fog', null],
      [scene, 'overrideMaterial', white_card ? this.#white : null], [renderer, 'autoClear', true],
    ];
    scene.traverse((object) => {
      const ambient = object.isAmbientLight || object.isHemisphereLight || object.isLightProbe;
      if (object.isLight && object !== this.#probe && (lights !== 'all' || ambient)) changes.push([object, 'visible', false]);
      if (taken.has(object)) changes.push([object, 'frustumCulled', false]);
      else if (object.isMesh || object.isLine || object.isPoints || object.isSprite) changes.push([object, 'visible', false]);
    });
    for (const material of this.#materials.keys()) if (material.lightMap) changes.push([material, 'lightMapIntensity', 0]);
    this.#probe.position.fromArray(to_light);
    this.#eye.position.fromArray(eye);
    const target = renderer.getRenderTarget(), clear = renderer.getClearColor(new THREE.Color()), alpha = renderer.getClearAlpha();
    having(changes, () => {
      try {
        renderer.setRenderTarget(this.#target);
        renderer.setClearColor(new THREE.Color(background, background, background), 1);
        renderer.render(scene, lights === 'all' ? this.#camera : this.#eye);
      } finally {
        renderer.setRenderTarget(target);
        renderer.setClearColor(clear, alpha);
      }
    });
  }
}
