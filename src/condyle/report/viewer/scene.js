// The knee in three.js: camera, light, and the poses of the run on a time line.

import {
  AmbientLight, AnimationMixer, Box3, BufferAttribute, Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene,
  SRGBColorSpace, Vector3, WebGLRenderer,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { colorAt, pressureColorAt, SLACK, UNSTRAINED } from './colors.js';
import { addElements } from './elements.js';

const nameOf = (node) => node.userData.name ?? node.name;

function addLights(scene, camera) {
  scene.add(new HemisphereLight(0xffffff, 0xb8a890, 1.5), new AmbientLight(0xffffff, 0.35), camera);
  const key = new DirectionalLight(0xffffff, 2.2);
  key.position.set(-0.4, 0.6, 1);  // beside the eye
  camera.add(key, key.target);
  key.target.position.set(0, 0, -1);
}

const MARGIN = 1.12;  // of the joint in the window

/// Every mesh gets a material of its own, so that one can be coloured or faded without the others.
function sortMeshes(root, data) {
  const meshes = {
    bones: [], cartilage: [], ligaments: new Map(), contacts: new Map(), bodies: new Map(data.bodies.map((b) => [b, []])),
    surfaceOf: (mesh) => [nameOf(mesh), nameOf(mesh.parent)],  // its names: one of them is that of the surface
  };
  root.traverse((node) => {
    const name = nameOf(node);
    if (meshes.bodies.has(name) && meshes.bodies.get(name).length === 0) meshes.bodies.get(name).push(node);
    if (!node.isMesh) return;
    const kind = node.material.name;
    node.material = node.material.clone();
    if (kind === 'bone') meshes.bones.push(node);
    if (kind === 'cartilage') meshes.cartilage.push(node);
    if (kind === 'cartilage') {  // lies in the bone's surface: a millimetre nearer to the eye
      node.material.polygonOffset = true;
      node.material.polygonOffsetUnits = -400;
    }
    if (kind === 'beyond the edge') {  // a sign: seen through everything
      Object.assign(node.material, { depthTest: false, transparent: true });
      node.renderOrder = 2;
    }
    if (kind === 'contact') {
      const holder = name.startsWith('contact ') ? name : nameOf(node.parent);
      meshes.contacts.set(holder.slice('contact '.length), [node]);
    }
    if (kind === 'ligament') {
      const holder = name.startsWith('ligament ') ? name : nameOf(node.parent);
      const ligament = holder.slice('ligament '.length).replace(/, piece \d+$/, '');  // one that wraps has several
      meshes.ligaments.set(ligament, [...(meshes.ligaments.get(ligament) ?? []), node]);
    }
  });
  return meshes;
}

function setOpacity(bones, opacity) {
  for (const bone of bones) {
    bone.material.transparent = opacity < 1;
    bone.material.opacity = opacity;
    bone.material.depthWrite = opacity > 0.95;
    bone.visible = opacity > 0;
    bone.renderOrder = 1;  // after what lies behind it
    bone.material.needsUpdate = true;
  }
}

const NEAR = 2;  // of half the diagonal of what touches: insertions farther away are no part of the joint

/// The articular surfaces and the ends of ligaments near them; of a knee without surfaces all there is.
function jointBox(meshes, root) {
  const box = new Box3();
  for (const mesh of meshes.cartilage) box.expandByObject(mesh);
  if (box.isEmpty()) return box.setFromObject(root);
  const center = box.getCenter(new Vector3()), reach = NEAR * 0.5 * box.getSize(new Vector3()).length();
  for (const ligament of [...meshes.ligaments.values()].flat()) {
    for (const end of [new Vector3(0, 0, 0), new Vector3(0, 1, 0)]) {
      const p = ligament.localToWorld(end);
      if (p.distanceTo(center) < reach) box.expandByPoint(p);
    }
  }
  return box;
}

/// A place between poses: the pose before it, the next, and how far from one to the other.
function between(list, at) {
  const i = Math.max(0, Math.min(Math.floor(at), list.length - 1));
  const k = Math.min(i + 1, list.length - 1);
  const a = list[i], b = list[k];
  if (at === i) return a;
  if (a === null || b === null) return a ?? b;
  return a + (b - a) * (at - i);
}

/// The articular surfaces whose vertices have a pressure at each pose (bytes, 0: not pressed), as what colours them.
function pressureMaps(meshes, data) {
  const shade = new Color();
  return (data.pressure?.surfaces ?? []).flatMap((surface) => {
    const mesh = meshes.cartilage.find((m) => meshes.surfaceOf(m).includes(surface.name));
    if (!mesh) return [];
    const levels = Uint8Array.from(atob(surface.levels), (c) => c.charCodeAt(0));
    const count = mesh.geometry.attributes.position.count;
    const plain = mesh.material.color.clone(), colors = new BufferAttribute(new Float32Array(3 * count), 3);
    mesh.geometry.setAttribute('color', colors);
    mesh.material.color.set(0xffffff);
    mesh.material.vertexColors = true;
    const table = Array.from({ length: 256 }, (_, level) =>
      level === 0 ? plain : shade.setRGB(...pressureColorAt((level - 1) / 254), SRGBColorSpace).clone());
    return [(pose) => {
      for (let i = 0; i < count; ++i) table[levels[pose * count + i]].toArray(colors.array, 3 * i);
      colors.needsUpdate = true;
    }];
  });
}

export async function createScene(canvas, model, data) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
  const scene = new Scene();
  const camera = new PerspectiveCamera(28, 1, 0.001, 10);
  addLights(scene, camera);
  const gltf = await new GLTFLoader().parseAsync(model, '');
  scene.add(gltf.scene);
  const mixer = new AnimationMixer(gltf.scene);
  for (const clip of gltf.animations) {
    const action = mixer.clipAction(clip);
    action.clampWhenFinished = true;
    action.play();
    action.paused = false;
  }
  const meshes = sortMeshes(gltf.scene, data);
  const pressures = pressureMaps(meshes, data);
  const orbit = new OrbitControls(camera, canvas);
  orbit.enableDamping = false;
  const first = data.times[0], end = data.times[data.times.length - 1];

  const api = { at: 0, picked: null, camera, root: gltf.scene, listeners: [] };
  const draw = () => renderer.render(scene, camera);

  /// `at` counts poses: 2.5 is half-way from the third to the fourth.
  api.show = (at) => {
    api.at = at;
    // A step before the end, where an animation would begin again.
    mixer.setTime(Math.min(between(data.times, at), end - 1e-6 * Math.max(1e-6, end - first)));
    for (const ligament of data.ligaments) {
      const taut = between(ligament.force, at) > 0;
      const known = ligament.has_strain ? colorAt(between(ligament.strain, at) / data.strain_top) : UNSTRAINED;
      const rgb = taut ? known : SLACK;
      for (const mesh of meshes.ligaments.get(ligament.name) ?? []) {
        mesh.material.color = new Color().setRGB(...rgb, SRGBColorSpace);
        mesh.material.transparent = !taut;
        mesh.material.opacity = taut ? 1 : 0.55;
      }
    }
    for (const paint of pressures) paint(Math.round(at));
    gltf.scene.updateMatrixWorld(true);
    draw();
    for (const listener of api.listeners) listener(at);
  };
  api.number = between;
  api.setBoneOpacity = (opacity) => { setOpacity(meshes.bones, opacity); draw(); };
  api.setVisible = (body, visible) => {
    for (const node of meshes.bodies.get(body) ?? []) node.visible = visible;
    draw();
  };
  api.bodyMatrix = (body) => (meshes.bodies.get(body)?.[0]?.matrixWorld.elements ?? []).slice();

  addElements(api, canvas, camera, meshes, data, draw);

  mixer.setTime(first);
  gltf.scene.updateMatrixWorld(true);
  const first_box = jointBox(meshes, gltf.scene);
  /// Looks from a direction (x to the person's left, y up, z to the front) at the joint in the first pose and the one
  /// that is shown.
  api.look = (direction) => {
    const box = jointBox(meshes, gltf.scene).union(first_box);
    const center = box.getCenter(new Vector3()), half = box.getSize(new Vector3()).multiplyScalar(0.5);
    const back = new Vector3(...direction).normalize();
    const right = new Vector3(0, 1, 0).cross(back).normalize(), up = back.clone().cross(right);
    const slope = Math.tan((0.5 * camera.fov * Math.PI) / 180);
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new Vector3(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
      const wide = Math.max(Math.abs(p.dot(up)), Math.abs(p.dot(right)) / camera.aspect);
      distance = Math.max(distance, p.dot(back) + (MARGIN * wide) / slope);
    }
    camera.position.copy(center).addScaledVector(back, distance);
    camera.near = distance / 100;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    orbit.target.copy(center);
    orbit.update();
    draw();
  };
  /// Where the joint lies in the window: from -1 to 1 in both directions.
  api.jointInWindow = () => {
    const box = jointBox(meshes, gltf.scene), seen = { left: 1, right: -1, bottom: 1, top: -1 };
    camera.updateMatrixWorld();
    for (let corner = 0; corner < 8; ++corner) {
      const p = new Vector3(...['x', 'y', 'z'].map((axis, i) => ((corner >> i) & 1 ? box.max : box.min)[axis]));
      p.project(camera);
      seen.left = Math.min(seen.left, p.x);
      seen.right = Math.max(seen.right, p.x);
      seen.bottom = Math.min(seen.bottom, p.y);
      seen.top = Math.max(seen.top, p.y);
    }
    return seen;
  };
  api.resize = () => {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0 || height === 0) return;
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    draw();
  };
  orbit.addEventListener('change', draw);
  window.addEventListener('resize', api.resize);
  setOpacity(meshes.bones, 0.45);
  return api;
}
