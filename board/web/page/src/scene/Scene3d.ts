import type { Context } from "../ui/context";
import { World3d } from "./World3d";
import { Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

export interface Scene3dHandle {
  stop(): void;
}

/** The same scene in three dimensions: z up, metres. */
export function startScene3d(place: HTMLElement, context: Context): Scene3dHandle {
  const { session, ui } = context;
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.setPixelRatio(window.devicePixelRatio || 1);
  const canvas = renderer.domElement;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "Field in three dimensions");
  place.append(canvas);
  const scene = new Scene();
  const camera = new PerspectiveCamera(45, 1, 0.05, 500);
  camera.up.set(0, 0, 1);
  scene.add(new HemisphereLight(0xffffff, 0x445544, 1.9));
  const sun = new DirectionalLight(0xffffff, 1.7);
  sun.position.set(4, -7, 12);
  scene.add(sun);
  const world = new World3d(scene, session.board);
  const controls = new OrbitControls(camera, canvas);
  controls.maxPolarAngle = Math.PI / 2 - 0.02;
  const resize = () => {
    const { clientWidth, clientHeight } = place;
    renderer.setSize(clientWidth, clientHeight);
    camera.aspect = clientWidth / Math.max(1, clientHeight);
    camera.updateProjectionMatrix();
    isDirty = true;
  };
  let isDirty = true;
  let drawn = -1;
  let drawnUi = -1;
  let hasPlace = false;
  let request = 0;
  let count = 0;
  const tick = () => {
    request = requestAnimationFrame(tick);
    const { board } = session;
    if (!board.world) return;
    if (!hasPlace) {
      hasPlace = true;
      const reach = board.world.max.y - board.world.min.y;
      camera.position.set(0, board.world.min.y - reach * 0.75, reach * 0.95);
      controls.target.set((board.world.min.x + board.world.max.x) / 2, (board.world.min.y + board.world.max.y) / 2, 0);
      controls.update();
    }
    if (drawn === board.frame && drawnUi === ui.frame && !isDirty) return;
    drawn = board.frame;
    drawnUi = ui.frame;
    isDirty = false;
    scene.background = new Color(ui.isDark ? 0x14181d : 0xdfe5ea);
    world.update(ui.layers);
    const pose = board.robot?.pose;
    if (ui.follow && pose) {
      controls.target.set(pose.x, pose.y, 0.2);
      controls.update();
    }
    renderer.render(scene, camera);
    canvas.dataset.drawn = String(++count);
  };
  controls.addEventListener("change", () => (isDirty = true));
  const watcher = new ResizeObserver(resize);
  watcher.observe(place);
  resize();
  tick();
  return {
    stop: () => {
      cancelAnimationFrame(request);
      watcher.disconnect();
      controls.dispose();
      world.dispose();
      renderer.dispose();
      canvas.remove();
    },
  };
}
