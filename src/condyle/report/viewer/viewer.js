// The 3-D view of a report: the run as glTF, its numbers as JSON, both embedded in the page.

import { createScene } from './scene.js';
import { createControls } from './controls.js';

function bytesOf(base64) {
  const text = atob(base64.replace(/\s+/g, ''));
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

async function start() {
  const place = document.getElementById('viewer');
  const message = document.getElementById('viewer-message');
  const data = JSON.parse(document.getElementById('viewer-data').textContent);
  try {
    const model = bytesOf(document.getElementById('viewer-model').textContent);
    const scene = await createScene(place.querySelector('canvas'), model, data);
    createControls(place, scene, data);
    message.hidden = true;
    place.hidden = false;
    scene.resize();
    scene.show(0);
    // For tests and the curious: the browser's console can turn the knee.
    window.condyleViewer = scene;
  } catch (error) {
    message.textContent =
      'The 3-D view needs WebGL, which this browser does not offer here. ' +
      'The pictures and tables below hold all there is to see. (' + error.message + ')';
    place.hidden = true;
  }
}

start();
