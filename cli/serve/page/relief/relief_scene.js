// The ground in three dimensions, with what stands on it and masts, drawn by three.js. x is east, y up, z south, in metres
// about the middle of the window.

import {
  CanvasTexture,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  Float32BufferAttribute,
  GLTFLoader,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  OrbitControls,
  PerspectiveCamera,
  SRGBColorSpace,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from "../vendor/three.js";

/** @typedef {import("./window.js").Extent} Extent */
/** @typedef {{id: number, x: number, y: number, ground: number, height: number, colour: string}} Standing */

const TERRAIN = "terrain";
const FIELD_OF_VIEW = 50;
/** The size of a mast's head on the screen, as a share of its distance. */
const HEAD = 0.008;
const TURN = Math.PI / 36; // by an arrow key

export class ReliefScene {
  #scene = new Scene();
  #camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 1, 1);
  #ground = new Group();
  #masts = new Group();
  #origin = [0, 0, 0];
  #size = 1;
  #waiting = false;
  /** @type {Standing | null} */
  #eye = null;

  /** Throws where the browser has no WebGL. @param {HTMLElement} box @param {HTMLCanvasElement} drape */
  constructor(box, drape) {
    this.box = box;
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, logarithmicDepthBuffer: true });
    this.renderer.setPixelRatio(devicePixelRatio);
    box.append(this.renderer.domElement);
    this.texture = new CanvasTexture(drape);
    this.texture.colorSpace = SRGBColorSpace;
    this.#scene.add(this.#ground, this.#masts, new HemisphereLight("#ffffff", "#8a8578", 1.6), sun());
    this.controls = new OrbitControls(this.#camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.resized = new ResizeObserver(() => this.#resize());
    this.resized.observe(box);
    box.addEventListener("keydown", (event) => this.#turnByKey(event));
  }

  /** Shows the triangles of a .glb file, with the drape over the extent. @param {ArrayBuffer} bytes
   * @param {Extent} extent @returns {Promise<Map<string, string>>} the colours of what stands on the ground, by theme */
  async take(bytes, extent) {
    const { scene: model } = await new GLTFLoader().parseAsync(bytes, "");
    this.#origin = model.userData.origin;
    this.#size = Math.max(extent[2] - extent[0], extent[3] - extent[1]);
    this.#forget();
    /** @type {Map<string, string>} */
    const colours = new Map();
    model.traverse((part) => part instanceof Mesh && this.#dress(part, extent, colours));
    this.#ground.add(model);
    this.#resize();
    return colours;
  }

  /** Gives the ground its drape; what stands on it keeps its colour. @param {Mesh} mesh @param {Extent} extent
   * @param {Map<string, string>} colours  Gets the colour. */
  #dress(mesh, [west, south, east, north], colours) {
    const { name, color } = /** @type {any} */ (mesh.material);
    if (name !== TERRAIN) {
      colours.set(name, `#${color.getHexString()}`);
      mesh.material = new MeshLambertMaterial({ color, side: DoubleSide, flatShading: true });
      return;
    }
    const position = mesh.geometry.getAttribute("position");
    const uv = new Float32Array(2 * position.count);
    for (let i = 0; i < position.count; ++i) {
      uv[2 * i] = (position.getX(i) + this.#origin[0] - west) / (east - west);
      uv[2 * i + 1] = (this.#origin[1] - position.getZ(i) - south) / (north - south);
    }
    mesh.geometry.setAttribute("uv", new Float32BufferAttribute(uv, 2));
    mesh.material = new MeshLambertMaterial({ map: this.texture, side: DoubleSide });
  }

  /** @param {Standing[]} standing */
  showMasts(standing) {
    this.#masts.clear();
    for (const { id, x, y, ground, height, colour } of standing) {
      const material = new MeshBasicMaterial({ color: colour });
      const pole = new Mesh(new CylinderGeometry(this.#size / 2500, this.#size / 2500, height), material);
      const head = new Mesh(new SphereGeometry(1, 24, 16), material);
      pole.position.copy(this.#place(x, y, ground + height / 2));
      head.position.copy(this.#place(x, y, ground + height));
      head.userData.head = true;
      const mast = new Group();
      mast.userData.id = id;
      mast.add(pole, head);
      this.#masts.add(mast);
    }
    const eye = standing.find(({ id }) => id === this.#eye?.id);
    if (eye) this.fromEye(eye, null);
    this.draw();
  }

  drapeChanged() {
    this.texture.dispose(); // the picture may have another size
    this.texture.needsUpdate = true;
    this.draw();
  }

  /** Looks from the south, from above. @param {Standing | null} at  What is looked at; the middle where there is none. */
  fromOutside(at) {
    this.#eye = null;
    const middle = at ? this.#place(at.x, at.y, at.ground) : new Vector3();
    const away = 0.75 * this.#size;
    this.#look(middle.clone().add(new Vector3(-0.25 * away, 0.55 * away, 0.8 * away)), middle);
    Object.assign(this.controls, { enableZoom: true, enablePan: true, rotateSpeed: 1, maxPolarAngle: 0.49 * Math.PI });
  }

  /** Looks from the head of a mast. @param {Standing} mast
   * @param {{x: number, y: number} | null} towards  In which direction; as before where there is none. */
  fromEye(mast, towards) {
    const eye = this.#place(mast.x, mast.y, mast.ground + mast.height);
    const before = this.controls.target.clone().sub(this.#camera.position);
    const ahead = towards ? this.#place(towards.x, towards.y, 0).sub(eye).setY(0) : before;
    this.#eye = mast;
    this.#look(eye, eye.clone().add(ahead.normalize()));
    // The eye stays where it is: turning about a point just ahead of it is turning the head.
    Object.assign(this.controls, { enableZoom: false, enablePan: false, rotateSpeed: -0.4, maxPolarAngle: Math.PI });
  }

  /** @param {Vector3} from @param {Vector3} to */
  #look(from, to) {
    this.#camera.position.copy(from);
    this.controls.target.copy(to);
    this.controls.update();
    this.draw();
  }

  /** @param {number} x @param {number} y @param {number} z */
  #place(x, y, z) {
    return new Vector3(x - this.#origin[0], z - this.#origin[2], this.#origin[1] - y);
  }

  /** @param {KeyboardEvent} event */
  #turnByKey(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const turn = turns[/** @type {keyof typeof turns} */ (event.key)];
    if (!turn) return;
    event.preventDefault();
    const fixed = this.#eye ? this.#camera.position : this.controls.target;
    const arm = (this.#eye ? this.controls.target : this.#camera.position).clone().sub(fixed);
    const flat = Math.hypot(arm.x, arm.z);
    const sense = this.#eye ? 1 : -1;
    const azimuth = Math.atan2(arm.x, -arm.z) + sense * turn[0] * TURN;
    const limit = 0.48 * Math.PI;
    const height = Math.atan2(arm.y, flat) + turn[1] * TURN;
    const altitude = Math.min(limit, Math.max(this.#eye ? -limit : 0.02, height));
    const long = arm.length();
    arm.set(
      long * Math.cos(altitude) * Math.sin(azimuth),
      long * Math.sin(altitude),
      -long * Math.cos(altitude) * Math.cos(azimuth),
    );
    (this.#eye ? this.controls.target : this.#camera.position).copy(fixed).add(arm);
    this.controls.update();
    this.draw();
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    Object.assign(this.#camera, { aspect: width / height, near: 0.05, far: 5 * this.#size });
    this.#camera.updateProjectionMatrix();
    this.draw();
  }

  /** Draws before the next picture. */
  draw() {
    if (this.#waiting) return;
    this.#waiting = true;
    requestAnimationFrame(() => {
      this.#waiting = false;
      for (const mast of this.#masts.children) {
        mast.visible = mast.userData.id !== this.#eye?.id;
        const head = mast.children[1];
        head.scale.setScalar(HEAD * this.#camera.position.distanceTo(head.position));
      }
      this.renderer.render(this.#scene, this.#camera);
    });
  }

  #forget() {
    this.#ground.traverse((part) => part instanceof Mesh && part.geometry.dispose());
    this.#ground.clear();
  }

  end() {
    this.resized.disconnect();
    this.#forget();
    this.controls.dispose();
    this.texture.dispose();
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }
}

/** The light of the map's hillshade, from the north-west. */
function sun() {
  const light = new DirectionalLight("#fff6e5", 2);
  light.position.set(-1, 1, -1);
  return light;
}
