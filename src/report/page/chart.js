// Curves in a plane that may turn back, with axes, zoom, hover and click.
import { axisBottom, axisLeft } from "d3-axis";
import { scaleLinear, scaleLog } from "d3-scale";
import { pointer, select } from "d3-selection";
import { line } from "d3-shape";
import { zoom, zoomIdentity } from "d3-zoom";

const margin = { left: 72, right: 16, top: 12, bottom: 44 };
const dashes = { stable: null, unstable: "2 4", unknown: null };
const shapes = { limit: "M-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z", bifurcation: "M-5,-5h10v10h-10z", hopf: "M0,-7L7,0L0,7L-7,0z" };
const widths = { stable: 2.4, unstable: 1.8, unknown: 1 };

function extent(values, log) {
  let low = Infinity,
    high = -Infinity;
  for (const v of values) {
    if (v === null || !Number.isFinite(v) || (log && v <= 0)) continue;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  if (!(low <= high)) return log ? [0.1, 1] : [0, 1];
  if (low === high) return log ? [low / 2, high * 2] : [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
  if (log) return [low / 1.3, high * 1.3];
  const room = 0.04 * (high - low);
  return [low - room, high + room];
}

/**
 * curves: [{name, colour, x, y, stability: ["stable", ...] of the stretches behind the points}]
 * marks: [{x, y, text, type: "limit", "bifurcation" or "hopf"}]
 * options: {xLabel, yLabel, logX, logY, height, onHover(curve, point) -> text, onClick(curve, point)}
 */
export class Chart {
  constructor(parent, options) {
    this.options = options;
    this.height = options.height || 420;
    this.svg = select(parent).append("svg").attr("class", "chart").attr("role", "img");
    this.clip = `clip${Chart.count++}`;
    this.svg.append("clipPath").attr("id", this.clip).append("rect");
    this.xAxis = this.svg.append("g").attr("class", "axis");
    this.yAxis = this.svg.append("g").attr("class", "axis");
    this.xName = this.svg.append("text").attr("text-anchor", "middle").attr("class", "label");
    this.yName = this.svg.append("text").attr("text-anchor", "middle").attr("class", "label");
    this.plane = this.svg.append("g").attr("clip-path", `url(#${this.clip})`);
    this.curveLayer = this.plane.append("g");
    this.markLayer = this.plane.append("g");
    this.chosen = this.plane.append("circle").attr("class", "chosen").attr("r", 6).style("display", "none");
    this.hovered = this.plane.append("circle").attr("class", "hovered").attr("r", 4).style("display", "none");
    this.tip = select(parent).append("div").attr("class", "tip").style("display", "none");
    this.transform = zoomIdentity;
    this.zoom = zoom()
      .scaleExtent([1, 200])
      .on("zoom", (event) => {
        this.transform = event.transform;
        this.draw();
      });
    this.svg.call(this.zoom).on("dblclick.zoom", () => this.svg.call(this.zoom.transform, zoomIdentity));
    this.svg.on("mousemove", (event) => this.hover(event)).on("mouseleave", () => this.unhover());
    this.svg.on("click", (event) => this.click(event));
    new ResizeObserver(() => this.draw()).observe(parent);
    this.parent = parent;
    this.set({ curves: [], marks: [] });
  }

  set({ curves, marks = [], xLabel, yLabel }) {
    this.curves = curves;
    this.marks = marks;
    this.xLabel = xLabel ?? this.options.xLabel ?? "";
    this.yLabel = yLabel ?? this.options.yLabel ?? "";
    this.choice = null;
    this.unhover();
    this.svg.call(this.zoom.transform, zoomIdentity);
    this.draw();
  }

  /** Marks one point. */
  choose(curve, point) {
    this.choice = curve === null ? null : { curve, point };
    this.draw();
  }

  scales() {
    const width = Math.max(280, this.parent.clientWidth);
    const { logX, logY } = this.options;
    const all = (name) => this.curves.flatMap((c) => Array.from(c[name]));
    const x = (logX ? scaleLog() : scaleLinear()).domain(extent(all("x"), logX)).range([margin.left, width - margin.right]);
    const y = (logY ? scaleLog() : scaleLinear()).domain(extent(all("y"), logY)).range([this.height - margin.bottom, margin.top]);
    return { width, x: this.transform.rescaleX(x), y: this.transform.rescaleY(y) };
  }

  draw() {
    const { width, x, y } = this.scales();
    const { logX, logY } = this.options;
    this.x = x;
    this.y = y;
    const bottom = this.height - margin.bottom;
    this.svg.attr("width", width).attr("height", this.height);
    this.svg
      .select(`#${this.clip} rect`)
      .attr("x", margin.left)
      .attr("y", margin.top)
      .attr("width", width - margin.left - margin.right)
      .attr("height", bottom - margin.top);
    this.xAxis.attr("transform", `translate(0,${bottom})`).call(
      axisBottom(x)
        .ticks(Math.max(3, width / 110), logX ? "~e" : undefined)
        .tickSize(margin.top - bottom),
    );
    this.yAxis.attr("transform", `translate(${margin.left},0)`).call(
      axisLeft(y)
        .ticks(6, logY ? "~e" : undefined)
        .tickSize(margin.left + margin.right - width),
    );
    this.xName
      .attr("x", (margin.left + width) / 2)
      .attr("y", this.height - 8)
      .text(this.xLabel);
    this.yName.attr("transform", `translate(14,${(margin.top + bottom) / 2}) rotate(-90)`).text(this.yLabel);
    const pieces = this.curves.flatMap((curve, c) => stretches(curve).map((piece) => ({ ...piece, curve, c })));
    const path = line(
      (p) => x(p[0]),
      (p) => y(p[1]),
    );
    this.curveLayer
      .selectAll("path")
      .data(pieces)
      .join("path")
      .attr("fill", "none")
      .attr("stroke", (p) => p.curve.colour)
      .attr("stroke-width", (p) => widths[p.stability])
      .attr("stroke-dasharray", (p) => dashes[p.stability])
      .attr("data-stability", (p) => p.stability)
      .attr("d", (p) => path(p.points));
    const dots = this.options.dots ? this.curves.flatMap((c) => Array.from(c.x, (v, i) => [v, c.y[i], c.colour])) : [];
    this.curveLayer
      .selectAll("circle")
      .data(dots.filter((d) => Number.isFinite(x(d[0])) && Number.isFinite(y(d[1]))))
      .join("circle")
      .attr("cx", (d) => x(d[0]))
      .attr("cy", (d) => y(d[1]))
      .attr("r", 2.5)
      .attr("fill", (d) => d[2]);
    const marks = this.markLayer
      .selectAll("g")
      .data(this.marks)
      .join((enter) => {
        const g = enter.append("g").attr("class", "mark");
        g.append("path");
        g.append("text").attr("dx", 9);
        return g;
      });
    marks.attr("transform", (m) => `translate(${x(m.x)},${y(m.y)})`);
    marks
      .select("path")
      .attr("d", (m) => shapes[m.type])
      .attr("fill", (m) => (m.type === "limit" ? "#fff" : "#111"))
      .attr("stroke", "#111")
      .attr("stroke-width", 1.6);
    // Above the mark, below it where the frame would cut it off.
    const top = Math.min(...y.range());
    marks
      .select("text")
      .attr("dy", (m) => (y(m.y) - top < 18 ? 17 : -7))
      .text((m) => m.text);
    this.show(this.chosen, this.choice);
  }

  show(circle, at) {
    const curve = at && this.curves[at.curve];
    const visible = curve && at.point < curve.x.length && curve.x[at.point] !== null && curve.y[at.point] !== null;
    circle.style("display", visible ? null : "none");
    if (visible) circle.attr("cx", this.x(curve.x[at.point])).attr("cy", this.y(curve.y[at.point]));
  }

  nearest(event) {
    const [px, py] = pointer(event, this.svg.node());
    const reach = 30; // pixels
    let best = null,
      least = reach * reach;
    this.curves.forEach((curve, c) => {
      for (let i = 0; i < curve.x.length; ++i) {
        if (curve.x[i] === null || curve.y[i] === null) continue;
        const dx = this.x(curve.x[i]) - px,
          dy = this.y(curve.y[i]) - py,
          d = dx * dx + dy * dy;
        if (d < least) [best, least] = [{ curve: c, point: i }, d];
      }
    });
    return best;
  }

  hover(event) {
    const at = this.nearest(event);
    this.show(this.hovered, at);
    const text = at && this.options.onHover ? this.options.onHover(at.curve, at.point) : "";
    this.tip.style("display", text ? null : "none").text(text || "");
    if (!text) return;
    const [px, py] = pointer(event, this.parent);
    const left = px > this.parent.clientWidth / 2;
    this.tip
      .style("left", left ? null : `${px + 14}px`)
      .style("right", left ? `${this.parent.clientWidth - px + 14}px` : null)
      .style("top", `${py + 8}px`);
  }

  unhover() {
    this.hovered.style("display", "none");
    this.tip.style("display", "none");
  }

  click(event) {
    const at = this.nearest(event);
    if (at && this.options.onClick) this.options.onClick(at.curve, at.point);
  }
}
Chart.count = 0;

/**
 * Points between i and i + 1 for the eye: cubics through the points of a step around them, over the path's length; within a step
 * the path is analytic. Curves without lengths and steps are drawn by chords.
 */
function between(curve, i) {
  const { length, steps, x, y } = curve;
  if (!length || !(length[i + 1] > length[i])) return [];
  const together = 1e-6 * (length[i + 1] - length[i]),
    nodes = [i, i + 1];
  if (i > 0 && steps[i] === steps[i + 1] && length[i] - length[i - 1] > together) nodes.unshift(i - 1);
  if (i + 2 < x.length && steps[i + 2] === steps[i + 1] && length[i + 2] - length[i + 1] > together) nodes.push(i + 2);
  if (nodes.length < 3 || nodes.some((n) => x[n] === null || y[n] === null)) return [];
  const parts = 8,
    points = [];
  for (let part = 1; part < parts; ++part) {
    const s = length[i] + ((length[i + 1] - length[i]) * part) / parts,
      point = [0, 0];
    for (const n of nodes) {
      let weight = 1;
      for (const m of nodes) if (m !== n) weight *= (s - length[m]) / (length[n] - length[m]);
      point[0] += weight * x[n];
      point[1] += weight * y[n];
    }
    points.push(point);
  }
  return points;
}

/** The runs of points with one stability, each up to the point where the next one begins. */
function stretches(curve) {
  const pieces = [];
  let piece = null;
  for (let i = 0; i < curve.x.length; ++i) {
    const point = [curve.x[i], curve.y[i]];
    if (point[0] === null || point[1] === null) {
      piece = null;
      continue;
    }
    if (piece) piece.points.push(...between(curve, i - 1), point);
    const stability = curve.stability ? curve.stability[i] : "stable";
    if (!piece || piece.stability !== stability) {
      piece = { stability, points: [point] };
      pieces.push(piece);
    }
  }
  return pieces.filter((p) => p.points.length > 1);
}
