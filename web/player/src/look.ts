// SPDX-License-Identifier: Apache-2.0
// The eye: the scene's cameras, orbit by pointer, flight by keys.

import type { Sconce } from 'sconce-three';
import { MathUtils, PerspectiveCamera, Raycaster, Spherical, Vector2, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const kTurn = 1.2; // radians per second
const kKeys = ['w', 'a', 's', 'd', 'q', 'e', 'arrowleft', 'arrowright', 'arrowup', 'arrowdown'];

export class Look {
  camera: PerspectiveCamera;
  onChange: () => void = () => {};

  private readonly controls: OrbitControls;
  private readonly held = new Set<string>();
  private readonly speed: number; // metres per second
  private yfov = 0.8;
  private aspect = 1;
  private last = 0;

  constructor(
    private readonly sconce: Sconce,
    canvas: HTMLCanvasElement,
  ) {
    this.camera = sconce.camera(0);
    this.controls = new OrbitControls(this.camera, canvas);
    const [lo, hi] = sconce.site.geometry.bounds;
    this.speed = 0.15 * Math.hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
    this.controls.addEventListener('change', () => this.onChange());
    canvas.addEventListener('keydown', (event) => this.press(event));
    canvas.addEventListener('keyup', (event) => this.held.delete(event.key.toLowerCase()));
    canvas.addEventListener('blur', () => this.held.clear());
    this.show(0);
  }

  show(index: number): void {
    const from = this.sconce.camera(index, this.aspect);
    this.yfov = this.sconce.site.cameras[index]!.yfov;
    this.camera.position.copy(from.position);
    this.camera.quaternion.copy(from.quaternion);
    this.resize(this.aspect);
    this.camera.updateMatrixWorld();
    const forward = this.camera.getWorldDirection(new Vector3());
    this.controls.target.copy(this.camera.position).addScaledVector(forward, this.distance());
    this.onChange();
  }

  /** The vertical angle is the camera's; upright pictures keep the width of a square one. */
  resize(aspect: number): void {
    this.aspect = this.camera.aspect = aspect;
    const half = Math.tan(this.yfov / 2) / Math.min(1, aspect);
    this.camera.fov = MathUtils.radToDeg(2 * Math.atan(Math.min(half, 1.5)));
    this.camera.updateProjectionMatrix();
    this.onChange();
  }

  /** To what is in the middle of the picture. */
  private distance(): number {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(), this.camera);
    const hit = ray.intersectObject(this.sconce, true)[0];
    return Math.max(hit?.distance ?? 0, this.speed);
  }

  private press(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if (!kKeys.includes(key) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (this.held.size === 0) {
      this.last = performance.now();
      requestAnimationFrame((now) => this.step(now));
    }
    this.held.add(key);
  }

  private step(now: number): void {
    if (this.held.size === 0) return;
    const seconds = Math.min(0.1, Math.max(0, (now - this.last) / 1000));
    this.last = now;
    const way = (plus: string, minus: string) => (this.held.has(plus) ? 1 : 0) - (this.held.has(minus) ? 1 : 0);
    this.fly(new Vector3(way('d', 'a'), way('e', 'q'), way('s', 'w')).multiplyScalar(this.speed * seconds));
    this.turn(kTurn * seconds * way('arrowleft', 'arrowright'), kTurn * seconds * way('arrowup', 'arrowdown'));
    this.onChange();
    requestAnimationFrame((next) => this.step(next));
  }

  /** Along the eye's own axes; up is the world's. */
  private fly(by: Vector3): void {
    const move = new Vector3(by.x, 0, by.z).applyQuaternion(this.camera.quaternion);
    move.y += by.y;
    this.camera.position.add(move);
    this.controls.target.add(move);
  }

  /** The head turns, the eye stays. */
  private turn(left: number, up: number): void {
    const forward = this.controls.target.clone().sub(this.camera.position);
    const at = new Spherical().setFromVector3(forward);
    at.theta += left;
    at.phi = MathUtils.clamp(at.phi - up, 0.05, Math.PI - 0.05);
    this.controls.target.copy(this.camera.position).add(new Vector3().setFromSpherical(at));
    this.camera.lookAt(this.controls.target);
  }
}
