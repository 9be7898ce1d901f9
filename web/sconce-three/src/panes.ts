// SPDX-License-Identifier: Apache-2.0
// Glass and blended surfaces, drawn from the farthest to the nearest.

import { BackSide, Box3, BufferGeometry, FrontSide, Mesh, type ShaderMaterial, Vector3 } from 'three';

import type { Pass } from './materials.js';

const kPasses: readonly Pass[] = ['passing', 'own'];
const kSides = [BackSide, FrontSide] as const; // the far one of what is closed first
const kMostPieces = 64; // of one batch

export type PaneMesh = Mesh<BufferGeometry, ShaderMaterial>;
export interface Pane {
  box: Box3;
  /** In the order in which they are drawn. */
  meshes: PaneMesh[];
}

interface Piece {
  first: number;
  count: number;
  box: Box3;
}

/** Triangles that hang together; the index is sorted by them within [first, first + count). */
function piecesOf(geometry: BufferGeometry, first: number, count: number): Piece[] {
  const index = geometry.index!.array as Uint32Array;
  const place = geometry.attributes.position!;
  const parent = Array.from({ length: count / 3 }, (_, t) => t);
  const root = (t: number): number => {
    while (parent[t] !== t) t = parent[t] = parent[parent[t]!]!;
    return t;
  };
  const at = (corner: number) => new Vector3().fromBufferAttribute(place, index[first + corner]!);
  const seen = new Map<string, number>();
  for (let corner = 0; corner < count; ++corner) {
    const key = at(corner).toArray().join();
    const triangle = Math.floor(corner / 3);
    const other = seen.get(key);
    if (other === undefined) seen.set(key, triangle);
    else parent[root(triangle)] = root(other);
  }
  const groups = new Map<number, number[]>();
  parent.forEach((_, t) => {
    const r = root(t);
    if (!groups.has(r)) groups.set(r, []);
    groups.get(r)!.push(t);
  });
  const parts = groups.size > kMostPieces ? [parent.map((_, t) => t)] : [...groups.values()];
  const sorted = new Uint32Array(count);
  const pieces: Piece[] = [];
  let end = 0;
  for (const triangles of parts) {
    const piece: Piece = { first: first + end, count: 3 * triangles.length, box: new Box3() };
    for (const t of triangles)
      for (let c = 0; c < 3; ++c) {
        piece.box.expandByPoint(at(3 * t + c));
        sorted[end++] = index[first + 3 * t + c]!;
      }
    pieces.push(piece);
  }
  index.set(sorted, first);
  return pieces;
}

/** @param material of a side and a pass of the batch */
export function panesOf(
  geometry: BufferGeometry,
  batch: { first: number; count: number },
  material: (side: typeof FrontSide | typeof BackSide, pass: Pass) => ShaderMaterial,
): Pane[] {
  const materials = kSides.flatMap((side) => kPasses.map((pass) => material(side, pass)));
  return piecesOf(geometry, batch.first, batch.count).map(({ first, count, box }) => {
    const part = new BufferGeometry();
    part.attributes = geometry.attributes;
    part.setIndex(geometry.index);
    part.setDrawRange(first, count);
    return { box, meshes: materials.map((m, order) => Object.assign(new Mesh(part, m), { renderOrder: 1 + (order % 2) })) };
  });
}

/** Nearer panes are drawn after farther ones. @param eye where they are looked at from, among them */
export function sortPanes(panes: readonly Pane[], eye: Vector3): void {
  [...panes]
    .sort((a, b) => b.box.distanceToPoint(eye) - a.box.distanceToPoint(eye))
    .forEach(({ meshes }, rank) => meshes.forEach((mesh, order) => (mesh.renderOrder = 1 + meshes.length * rank + order)));
}
