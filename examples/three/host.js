// SPDX-License-Identifier: Apache-2.0
// A small three.js program with materials and lights of its own; the only lines about bounces are those that name
// ThreeRadiosity. With ?pictures it posts what it shows without and with them, before and after its shaders changed.
import * as THREE from 'three';

import { ThreeRadiosity } from './glue.js';

const room = await (await fetch('room.json')).json();
const renderer = new THREE.WebGLRenderer({ canvas: document.getElementById('view') });
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(room.fov, room.width / room.height, 0.05, 50);
const lamp = new THREE.PointLight(new THREE.Color(...room.strength), Math.PI, 0, 0);
const materials = room.paints.map(({ name, color, emission }) => {
  const shine = name === 'lacquer' ? room.shine : 0;
  const paint = { name, color: new THREE.Color(...color), emissive: new THREE.Color(...emission) };
  return shine > 0
    ? new THREE.MeshPhongMaterial({ ...paint, specular: new THREE.Color(shine, shine, shine), shininess: 30 })
    : new THREE.MeshLambertMaterial(paint);
});

function build() {
  camera.position.set(...room.eye);
  camera.lookAt(...room.target);
  lamp.position.set(...room.lamp);
  scene.add(lamp);
  for (const { paint, corner, a, b } of room.walls) {
    const [at, u, v] = [corner, a, b].map((t) => new THREE.Vector3(...t));
    const corners = [at, at.clone().add(u), at.clone().add(u).add(v), at.clone().add(v)];
    const normal = u.clone().cross(v).normalize();
    const geometry = new THREE.BufferGeometry().setFromPoints(corners).setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute('normal', new THREE.Float32BufferAttribute(corners.flatMap(() => normal.toArray()), 3));
    scene.add(new THREE.Mesh(geometry, materials[paint]));
  }
}

/** Light falls off with the square of the distance over 2 m: the program's shaders change while it runs. */
function attenuate() {
  const lights = THREE.ShaderChunk.lights_pars_begin.replace('return distanceFalloff;', 'return distanceFalloff * 4.0 / (lightDistance * lightDistance);');
  for (const material of materials) {
    material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace('#include <lights_pars_begin>', lights);
    };
    material.needsUpdate = true;
  }
}

async function post(name) {
  const target = new THREE.WebGLRenderTarget(room.width, room.height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  renderer.setRenderTarget(null);
  const rgba = new Float32Array(4 * room.width * room.height);
  renderer.readRenderTargetPixels(target, 0, 0, room.width, room.height, rgba);
  target.dispose();
  await fetch(`picture?name=${name}`, { method: 'POST', body: rgba });
}

async function pictures() {
  const show = (on) => materials.forEach((m) => (m.lightMapIntensity = on ? Math.PI : 0));
  await post('without');
  const radiosity = await ThreeRadiosity.start(renderer, scene, camera);
  await post('direct');
  for (const name of ['with', 'changed', 'painted']) {
    const { fault } = await radiosity.update();
    if (fault) throw new Error(fault);
    show(true);
    await post(name);
    if (name === 'with') attenuate();
    show(false);
    if (name !== 'with') await post(`${name}-direct`);
    if (name !== 'changed') continue;
    materials[room.repainted].color.setRGB(...room.new_color);
    await radiosity.detect();
  }
  await fetch('done', { method: 'POST' });
}

async function demo() {
  const status = document.getElementById('status'), bounces = document.getElementById('bounces');
  let radiosity = null;
  const resize = () => {
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
  };
  addEventListener('resize', resize);
  resize();
  renderer.setAnimationLoop((time) => {
    lamp.position.set(2.5 + 1.8 * Math.cos(time / 3000), 2.2, 2 + 1.4 * Math.sin(time / 3000));
    for (const m of materials) m.lightMapIntensity = radiosity && bounces.checked ? Math.PI : 0;
    renderer.render(scene, camera);
  });
  status.textContent = 'looking at the materials and following rays';
  radiosity = await ThreeRadiosity.start(renderer, scene, camera);
  Object.assign(window, { radiosity, renderer, scene, camera, lamp, materials });
  document.documentElement.dataset.state = 'ready';
  for (;;) {
    const { fault, drawn, read, solved } = await radiosity.update();
    status.textContent = fault ? `without bounces: ${fault}` : `${drawn.toFixed(1)} ms drawn and read (${read.toFixed(1)} ms), ${solved.toFixed(1)} ms solved`;
    await new Promise(requestAnimationFrame);
  }
}

try {
  build();
  await (location.search === '?pictures' ? pictures() : demo());
  document.documentElement.dataset.state = 'done';
} catch (error) {
  document.getElementById('status').textContent = `without bounces: ${error.message}`;
  document.documentElement.dataset.state = 'failed';
}
