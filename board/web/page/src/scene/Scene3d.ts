import type { Context } from "../ui/context";
import { World3d } from "./World3d";
import { Color, DirectionalLight, HemisphereLight, PCFSoftShadowMap, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

export interface Scene3dHandle {
  stop(): void;
}

type Corner = { x: number; y: number };

const cornersOf = (min: Corner, max: Corner): Vector3[] =>
  [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [0, 1].map((z) => new Vector3(x, y, z))));

const kEdge = 0.94; // of half the view
const isInside = ({ x, y, z }: Vector3): boolean => Math.abs(x) < kEdge && Math.abs(y) < kEdge && z < 1;

/** Shadows fall all over the field. */
function lightAll(sun: DirectionalLight, min: Corner, max: Corner): void {
  const reach = Math.hypot(max.x - min.x, max.y - min.y) / 2 + 1;
  const [x, y] = [(min.x + max.x) / 2, (min.y + max.y) / 2];
  sun.target.position.set(x, y, 0);
  sun.position.set(x + 0.28 * reach, y - 0.49 * reach, 0.84 * reach);
  Object.assign(sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0, far: 2.5 * reach });
  sun.shadow.camera.updateProjectionMatrix();
}

/** The same scene in three dimensions: z up, metres. */
export function startScene3d(place: HTMLElement, context: Context): Scene3dHandle {
  const { session, ui } = context;
  const renderer = new WebGLRenderer({ antialias: true });
  renderer.setPixelRatio(window.devicePixelRatio || 1);
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFSoftShadowMap;
  const canvas = renderer.domElement;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "Field in three dimensions");
  place.append(canvas);
  const scene = new Scene();
  const camera = new PerspectiveCamera(45, 1, 0.05, 2000);
  camera.up.set(0, 0, 1);
  scene.add(new HemisphereLight(0xffffff, 0x445544, 1.9));
  const sun = new DirectionalLight(0xffffff, 1.7);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  sun.shadow.normalBias = 0.06;
  sun.shadow.bias = -0.0005;
  scene.add(sun, sun.target);
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
      const { min, max } = board.world;
      const middle = { x: (min.x + max.x) / 2, y: (min.y + max.y) / 2 };
      lightAll(sun, min, max);
      controls.target.set(middle.x, middle.y, 0);
      // So far away that all corners are seen.
      for (let away = 1; away < 1000; away *= 1.1) {
        camera.position.set(middle.x, middle.y - 0.65 * away, 0.76 * away);
        controls.update();
        camera.updateMatrixWorld();
        if (cornersOf(min, max).every((corner) => isInside(corner.project(camera)))) break;
      }
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
