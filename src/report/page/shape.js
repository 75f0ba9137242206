// The deformed body in space: turns under the mouse, goes along the path with a slider, coloured by a field.
import { interpolateViridis } from "d3-scale-chromatic";
import {
  AmbientLight,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  DoubleSide,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene,
  Color,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { data, element, floats, goTo, integers, shown, watchPlace } from "./data.js";

const kNone = "none",
  kSize = "displacement";

class Body {
  constructor(shape) {
    this.rest = floats(shape.positions);
    this.triangles = integers(shape.triangles); // [triangle][3] nodes
    this.ofElement = integers(shape.triangle_elements);
    this.edges = integers(shape.edges);
    this.surface = geometry(this.triangles.length);
    this.surface.setAttribute("color", new BufferAttribute(new Float32Array(3 * this.triangles.length), 3));
    this.lines = geometry(this.edges.length);
    this.restLines = geometry(this.edges.length);
    place(this.restLines, this.edges, (n, k) => this.rest[3 * n + k]);
  }

  deform(u, scale) {
    const x = (n, k) => this.rest[3 * n + k] + scale * u[3 * n + k];
    place(this.surface, this.triangles, x);
    place(this.lines, this.edges, x);
    this.surface.computeVertexNormals();
    this.surface.computeBoundingSphere();
  }

  colour(valueAt, low, high) {
    const colours = this.surface.attributes.color,
      colour = new Color();
    for (let i = 0; i < this.triangles.length; ++i) {
      const value = valueAt(this.triangles[i], this.ofElement[Math.floor(i / 3)]);
      if (value === null || !Number.isFinite(value)) colour.set("#9fb4c7");
      else colour.set(interpolateViridis(high > low ? (value - low) / (high - low) : 0.5));
      colours.setXYZ(i, colour.r, colour.g, colour.b);
    }
    colours.needsUpdate = true;
  }

  /** Centre and radius of a box around the body at rest and with each of these displacements. */
  sphere(displacements) {
    const at = new Vector3(),
      low = new Vector3(Infinity, Infinity, Infinity),
      high = low.clone().negate();
    for (const u of [new Float32Array(this.rest.length), ...displacements])
      for (let i = 0; i < this.rest.length; i += 3) {
        at.set(this.rest[i] + u[i], this.rest[i + 1] + u[i + 1], this.rest[i + 2] + u[i + 2]);
        low.min(at);
        high.max(at);
      }
    return { centre: low.clone().add(high).multiplyScalar(0.5), radius: low.distanceTo(high) / 2 || 1 };
  }
}

function geometry(vertices) {
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(new Float32Array(3 * vertices), 3));
  return made;
}

function place(of, nodes, coordinate) {
  const at = of.attributes.position;
  for (let i = 0; i < nodes.length; ++i) at.setXYZ(i, coordinate(nodes[i], 0), coordinate(nodes[i], 1), coordinate(nodes[i], 2));
  at.needsUpdate = true;
  of.computeBoundingSphere();
}

/** The rigid tools: grey, the body is seen through them. */
class Tools {
  constructor(surfaces, scene) {
    const material = new MeshLambertMaterial({ color: "#8c8274", side: DoubleSide, transparent: true, opacity: 0.4, depthWrite: false });
    this.meshes = surfaces.map((tool) => {
      const made = new BufferGeometry();
      made.setAttribute("position", new BufferAttribute(floats(tool.positions), 3));
      made.setIndex(new BufferAttribute(integers(tool.triangles), 1));
      made.computeVertexNormals();
      const mesh = new Mesh(made, material);
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      scene.add(mesh);
      return mesh;
    });
  }

  /** `motions`: of every tool a matrix, row by row, and a shift; none where the state has none. */
  move(motions, scale, shown) {
    this.meshes.forEach((mesh, t) => {
      mesh.visible = shown && motions !== null;
      if (!motions) return;
      const m = motions.subarray(12 * t, 12 * t + 12);
      const r = (i, j) => (i === j ? 1 : 0) + scale * (m[3 * i + j] - (i === j ? 1 : 0)); // displacements times the scale
      const c = (i) => scale * m[9 + i];
      mesh.matrix.set(r(0, 0), r(0, 1), r(0, 2), c(0), r(1, 0), r(1, 1), r(1, 2), c(1), r(2, 0), r(2, 1), r(2, 2), c(2), 0, 0, 0, 1);
      mesh.matrixWorldNeedsUpdate = true;
    });
  }
}

export function showShape(parent) {
  const shape = data.shape;
  const canvas = element("canvas", { id: "shape" });
  let renderer;
  try {
    renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  } catch {
    parent.append(element("p", { class: "note" }, "This browser draws nothing in space (no WebGL); the deformed shape is not shown."));
    return;
  }
  const body = new Body(shape);
  const scene = new Scene(),
    camera = new PerspectiveCamera(35, 1, 1e-3, 1e6);
  scene.background = new Color("#f7f8fa");
  const sun = new DirectionalLight(0xffffff, 2.2);
  camera.add(sun);
  scene.add(camera, new AmbientLight(0xffffff, 1.4));
  const surface = new Mesh(
    body.surface,
    new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }),
  );
  const lines = new LineSegments(body.lines, new LineBasicMaterial({ color: "#20303c" }));
  const rest = new LineSegments(body.restLines, new LineBasicMaterial({ color: "#b8c2cc" }));
  for (const object of [surface, lines, rest]) object.frustumCulled = false;
  scene.add(surface, lines, rest);
  const tools = new Tools(shape.tools ?? [], scene);
  const controls = new OrbitControls(camera, canvas);
  controls.addEventListener("change", render);

  const branches = shape.branches;
  const branchChoice = element("select", { id: "shape-branch" });
  branches.forEach((b, i) => branchChoice.append(element("option", { value: i }, b.name)));
  const slider = element("input", { type: "range", id: "shape-state", min: 0, value: 0, step: 1, "aria-label": "state along the path" });
  const field = element("select", { id: "shape-field" });
  const names = shape.fields.map((f) => f.name);
  for (const name of [...(shape.moves ? [kSize] : []), ...names, kNone]) field.append(element("option", { value: name }, name));
  const scale = element("input", { id: "shape-scale", type: "number", value: 1, step: "any", min: 0 });
  const edges = element("input", { type: "checkbox", checked: "" });
  const undeformed = element("input", { type: "checkbox" });
  const withTools = element("input", { id: "shape-tools", type: "checkbox", checked: "" });
  const says = element("output", { id: "shape-says" });
  const legend = element("div", { class: "ramp" });
  parent.append(
    element(
      "div",
      { class: "controls" },
      element("label", {}, "path ", branchChoice),
      element("label", { class: "wide" }, "state ", slider),
      element("label", {}, "colour ", field),
      ...(shape.moves ? [element("label", {}, "displacements times ", scale)] : []),
      element("label", {}, edges, " edges"),
      ...(shape.moves ? [element("label", {}, undeformed, " undeformed")] : []),
      ...(shape.tools ? [element("label", {}, withTools, " tools")] : []),
    ),
    says,
    canvas,
    legend,
  );

  const decoded = new Map();
  const read = (b, s) => {
    const key = `${b}/${s}`;
    if (!decoded.has(key)) {
      if (decoded.size > 40) decoded.clear();
      const state = branches[b].states[s];
      decoded.set(key, { u: floats(state.displacement), fields: state.fields.map(floats), motions: state.tools ? floats(state.tools) : null });
    }
    return decoded.get(key);
  };

  /** [node or element] values and whether they are of nodes. */
  function valuesOf(state) {
    if (field.value === kNone) return null;
    if (field.value === kSize) {
      const size = new Float32Array(state.u.length / 3);
      for (let n = 0; n < size.length; ++n) size[n] = Math.hypot(state.u[3 * n], state.u[3 * n + 1], state.u[3 * n + 2]);
      return { values: size, ofNodes: true };
    }
    const i = shape.fields.findIndex((f) => f.name === field.value);
    return { values: state.fields[i], ofNodes: shape.fields[i].of === "node" };
  }

  function update() {
    const b = Number(branchChoice.value),
      states = branches[b].states,
      s = Math.min(Number(slider.value), states.length - 1);
    const state = read(b, s),
      values = valuesOf(state);
    body.deform(state.u, Number(scale.value) || 0);
    tools.move(state.motions, Number(scale.value) || 0, withTools.checked);
    let low = Infinity,
      high = -Infinity;
    if (values)
      for (const v of values.values)
        if (Number.isFinite(v)) {
          low = Math.min(low, v);
          high = Math.max(high, v);
        }
    body.colour((node, of) => (values ? values.values[values.ofNodes ? node : of] : null), low, high);
    legend.replaceChildren();
    if (values) {
      const bar = element("span", { class: "bar" });
      bar.style.background = `linear-gradient(to right, ${[0, 0.25, 0.5, 0.75, 1].map(interpolateViridis).join(", ")})`;
      legend.append(field.value, " ", shown(low, 4), " ", bar, " ", shown(high, 4), values.ofNodes ? "" : " (means of elements)");
    }
    says.textContent = `${branches[b].name}: state ${s + 1} of ${states.length}, load factor ${shown(states[s].load_factor)}, path length ${shown(states[s].path_length)}`;
    says.dataset.state = s;
    says.dataset.branch = b;
    lines.visible = edges.checked;
    rest.visible = undeformed.checked;
    render();
  }

  function render() {
    renderer.render(scene, camera);
  }

  function resize() {
    const width = parent.clientWidth,
      height = Math.max(320, Math.min(560, 0.6 * width));
    renderer.setPixelRatio(window.devicePixelRatio);
    renderer.setSize(width, height, true);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    render();
  }

  function look() {
    const { centre, radius } = body.sphere(branches.map((b, i) => read(i, b.states.length - 1).u));
    const flat = shape.dimension === 2;
    const from = flat ? new Vector3(0, 0, 1) : new Vector3(0.9, -1.4, 0.8).normalize();
    camera.up.set(0, flat ? 1 : 0, flat ? 0 : 1);
    camera.position.copy(centre).addScaledVector(from, 3.1 * radius);
    camera.near = radius / 100;
    camera.far = 100 * radius;
    camera.updateProjectionMatrix();
    controls.target.copy(centre);
    controls.update();
  }

  const chooseBranch = () => {
    slider.max = branches[Number(branchChoice.value)].states.length - 1;
  };
  branchChoice.addEventListener("change", () => {
    chooseBranch();
    slider.value = slider.max;
    tell();
  });
  const tell = () => {
    const branch = branches[Number(branchChoice.value)],
      state = branch.states[Number(slider.value)];
    goTo({ branch: branch.number, length: state.path_length });
  };
  slider.addEventListener("input", tell);
  scale.addEventListener("input", update);
  for (const choice of [field, edges, undeformed, withTools]) choice.addEventListener("change", update);
  watchPlace((to) => {
    const b = branches.findIndex((branch) => branch.number === to.branch);
    if (b < 0) return;
    branchChoice.value = b;
    chooseBranch();
    let best = 0;
    branches[b].states.forEach((state, s) => {
      if (Math.abs(state.path_length - to.length) < Math.abs(branches[b].states[best].path_length - to.length)) best = s;
    });
    slider.value = best;
    update();
  });
  chooseBranch();
  slider.value = slider.max;
  look();
  resize();
  update();
  new ResizeObserver(resize).observe(parent);
}
