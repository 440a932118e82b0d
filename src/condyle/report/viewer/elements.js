// Ligaments and contacts in the view: which of them lies at a place of the window, and a rim about the one that is picked.

import { BackSide, CylinderGeometry, Mesh, MeshBasicMaterial, Raycaster, SphereGeometry, Vector2, Vector3 } from 'three';

const RINGS = [0, 4, 9];  // pixels about the pointer, the first that meets a ligament or a point of contact counts
const RIM = 1.9;          // of the radius of what it is about
const GLOW = 0.15;        // of a picked contact's surfaces

const isShown = (node) => {
  for (let at = node; at !== null; at = at.parent) if (!at.visible) return false;
  return node.getWorldScale(new Vector3()).length() > 1e-6;
};

/// Of each thing that can be met the element it is of; nothing of what only hides others.
function targetsOf(meshes, data) {
  const targets = new Map();
  const add = (mesh, choice) => targets.set(mesh, choice);
  for (const mesh of meshes.bones) add(mesh, null);
  for (const mesh of meshes.cartilage) {
    const contact = data.contacts.find((c) => c.surfaces.some((surface) => meshes.surfaceOf(mesh).includes(surface)));
    add(mesh, contact ? { kind: 'contact', name: contact.name, surface: true } : null);
  }
  for (const [name, all] of meshes.ligaments) for (const mesh of all) add(mesh, { kind: 'ligament', name });
  for (const [name, all] of meshes.contacts) for (const mesh of all) add(mesh, { kind: 'contact', name });
  return targets;
}

/// The inside of a wider shell, of a ligament without ends: those of a bent one's pieces would stand before the next piece.
function rimOf(mesh, ligament, color) {
  mesh.geometry.computeBoundingBox();
  const radius = RIM * mesh.geometry.boundingBox.max.x;
  const shell = ligament ? new CylinderGeometry(radius, radius, 1, 24, 1, true).translate(0, 0.5, 0) : new SphereGeometry(radius, 24, 16);
  const rim = new Mesh(shell, new MeshBasicMaterial({ color, side: BackSide }));
  rim.raycast = () => {};
  mesh.add(rim);
  return rim;
}

export function addElements(api, canvas, camera, meshes, data, draw) {
  const targets = targetsOf(meshes, data), raycaster = new Raycaster();
  const nearest = (x, y) => {
    const frame = canvas.getBoundingClientRect();
    raycaster.setFromCamera(new Vector2((2 * (x - frame.left)) / frame.width - 1, 1 - (2 * (y - frame.top)) / frame.height), camera);
    const solid = [...targets.keys()].filter((mesh) => isShown(mesh) && !(meshes.bones.includes(mesh) && mesh.material.opacity < 0.95));
    const hit = raycaster.intersectObjects(solid, false)[0];
    return hit ? targets.get(hit.object) : null;
  };

  /// The ligament or contact at a place of the window [pixel], or null.
  api.elementAt = (x, y) => {
    let surface = null;
    for (const radius of RINGS) {
      const around = radius === 0 ? [0] : [0, 1, 2, 3, 4, 5, 6, 7];
      for (const k of around) {
        const found = nearest(x + radius * Math.cos((k * Math.PI) / 4), y + radius * Math.sin((k * Math.PI) / 4));
        if (found && !found.surface) return { kind: found.kind, name: found.name };
        if (radius === 0) surface = found;
      }
    }
    return surface && { kind: surface.kind, name: surface.name };
  };

  /// Where in the window a ligament's middle or a point of contact is [pixel].
  api.placeOf = (choice) => {
    const all = (choice.kind === 'ligament' ? meshes.ligaments : meshes.contacts).get(choice.name) ?? [];
    const mesh = all[Math.floor(all.length / 2)];
    if (!mesh) return null;
    const middle = mesh.localToWorld(new Vector3(0, choice.kind === 'ligament' ? 0.5 : 0, 0)).project(camera);
    const frame = canvas.getBoundingClientRect();
    return [frame.left + (0.5 + 0.5 * middle.x) * frame.width, frame.top + (0.5 - 0.5 * middle.y) * frame.height];
  };

  let rims = [], glowing = [];
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  api.highlight = (choice) => {
    for (const rim of rims) {
      rim.removeFromParent();
      rim.geometry.dispose();
      rim.material.dispose();
    }
    for (const mesh of glowing) mesh.material.emissive.setScalar(0);
    rims = glowing = [];
    if (choice !== null) {
      const ligament = choice.kind === 'ligament';
      const all = (ligament ? meshes.ligaments : meshes.contacts).get(choice.name) ?? [];
      rims = all.map((mesh) => rimOf(mesh, ligament, dark.matches ? 0xffffff : 0x101418));
      const surfaces = ligament ? [] : data.contacts.find((c) => c.name === choice.name).surfaces;
      glowing = meshes.cartilage.filter((mesh) => surfaces.some((surface) => meshes.surfaceOf(mesh).includes(surface)));
      for (const mesh of glowing) mesh.material.emissive.setScalar(GLOW);
    }
    draw();
  };
}
