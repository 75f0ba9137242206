// The page of `atrapos report`: sections that all follow one place on the path.
import { Chart } from "./chart.js";
import { colourOf, data, element, goTo, place, shown, watchPlace } from "./data.js";
import { showShape } from "./shape.js";
import style from "./style.css";

const most = 300; // rows of a table at once

function section(title, ...children) {
  const made = element("section", {}, element("h2", {}, title), ...children);
  document.body.append(made);
  return made;
}

function table(columns, rows, options = {}) {
  const head = element("tr", {}, ...columns.map((c) => element("th", {}, c)));
  const body = element("tbody");
  const fill = (first) => {
    body.replaceChildren(
      ...rows.slice(first, first + most).map((row, i) => {
        const line = element("tr", {}, ...row.map((cell) => element("td", {}, shown(cell))));
        if (options.onClick) {
          line.className = "linked";
          line.addEventListener("click", () => options.onClick(first + i));
        }
        if (options.chosen === first + i) line.classList.add("now");
        return line;
      }),
    );
  };
  const box = element("div", { class: "table" }, element("table", {}, element("thead", {}, head), body));
  let first = 0;
  const pages = element("div", { class: "pages" });
  const turn = (by) => {
    first = Math.max(0, Math.min(first + by, Math.floor((rows.length - 1) / most) * most));
    fill(first);
    says.textContent = ` rows ${first + 1} to ${Math.min(rows.length, first + most)} of ${rows.length} `;
  };
  const says = element("span");
  if (rows.length > most) {
    pages.append(element("button", { onclick: () => turn(-most) }, "before"), says, element("button", { onclick: () => turn(most) }, "after"));
    box.append(pages);
  }
  turn(0);
  box.choose = (row) => {
    options.chosen = row;
    first = Math.floor(row / most) * most;
    turn(0);
    const line = body.children[row - first];
    if (line) line.parentElement.parentElement.parentElement.scrollTop = line.offsetTop - 60;
  };
  return box;
}

// ---------------------------------------------------------------------------------------------- head

function head() {
  document.title = `${data.title} – atrapos`;
  const s = data.summary;
  document.body.append(
    element(
      "header",
      {},
      element("h1", {}, data.title),
      element(
        "p",
        { id: "ended" },
        s ? `${s.why}; ${s.steps} steps, ${shown(s.seconds?.total, 3)} s; ${s.program}` : "the run has not finished: there is no summary.json",
      ),
    ),
  );
  if (data.notes.length > 0) document.body.append(element("ul", { class: "notes" }, ...data.notes.map((n) => element("li", {}, n))));
}

// ---------------------------------------------------------------------------------------------- path

const words = (mark) => ({ limit: `${mark.kind} of the load`, bifurcation: mark.kind, hopf: "Hopf point" })[mark.type];

function pathSection() {
  const names = data.quantities.map((q) => q.name);
  const xChoice = element("select", { id: "path-x" }),
    yChoice = element("select", { id: "path-y" });
  for (const choice of [xChoice, yChoice]) names.forEach((n, i) => choice.append(element("option", { value: i }, n)));
  xChoice.value = data.axes.x;
  yChoice.value = data.axes.y;
  const legend = element("div", { class: "legend" });
  const hidden = new Set();
  const box = element("div", { class: "plot", id: "path-plot" });
  section(
    "Path",
    element("div", { class: "controls" }, element("label", {}, "over ", xChoice), element("label", {}, "show ", yChoice)),
    legend,
    box,
    element(
      "p",
      { class: "hint" },
      "Thick: stable; dotted: unstable; thin: not counted. Circles: limit points, squares: bifurcation points, diamonds: Hopf points. Wheel and drag: zoom, double click: all; click: that state.",
    ),
  );
  const chart = new Chart(box, {
    height: 460,
    onHover: (c, i) => {
      const b = visible()[c];
      const mark = b.marks.find((m) => m.point === i);
      return [b.name + (mark ? `: ${words(mark)}` : ""), `step ${b.steps[i]}`, ...names.map((n, q) => `${n} = ${shown(b.values[q][i])}`)].join("\n");
    },
    onClick: (c, i) => {
      const b = visible()[c];
      goTo({ branch: b.number, length: b.values[1][i], step: b.steps[i] });
    },
  });
  const visible = () => data.branches.filter((b) => !hidden.has(b.number));
  const stabilities = ["stable", "unstable", "unknown"];

  function draw() {
    const x = Number(xChoice.value),
      y = Number(yChoice.value);
    const curves = visible().map((b) => ({
      colour: colourOf(data.branches.indexOf(b)),
      x: b.values[x],
      y: b.values[y],
      length: b.thinned ? null : b.values[1],
      steps: b.steps,
      stability: Array.from(b.stability, (s) => stabilities[Number(s)]),
    }));
    const marks = visible()
      .flatMap((b) =>
        b.marks.map((m) => ({
          x: b.values[x][m.point],
          y: b.values[y][m.point],
          type: m.type,
          text: shown(b.values[0][m.point], 4),
        })),
      )
      .filter((m) => m.x !== null && m.y !== null);
    const few = 14;
    if (marks.length > few) for (const m of marks) m.text = "";
    chart.set({ curves, marks, xLabel: names[x], yLabel: names[y] });
    follow();
  }

  function follow() {
    if (!place) return;
    const c = visible().findIndex((b) => b.number === place.branch);
    if (c < 0) return chart.choose(null);
    const lengths = visible()[c].values[1];
    let best = 0;
    lengths.forEach((l, i) => {
      if (Math.abs(l - place.length) < Math.abs(lengths[best] - place.length)) best = i;
    });
    chart.choose(c, best);
  }

  if (data.branches.length > 1)
    data.branches.forEach((b, i) => {
      const key = element("button", { class: "key" }, element("span", { class: "swatch" }), b.name);
      key.firstChild.style.background = colourOf(i);
      key.addEventListener("click", () => {
        if (!hidden.delete(b.number)) hidden.add(b.number);
        key.classList.toggle("off");
        draw();
      });
      legend.append(key);
    });
  xChoice.addEventListener("change", draw);
  yChoice.addEventListener("change", draw);
  watchPlace(follow);
  draw();
}

// ---------------------------------------------------------------------------------------------- tables

function pointsSection() {
  const marks = data.branches.flatMap((b) => b.marks.map((m) => ({ b, m })));
  if (marks.length === 0) return;
  const columns = ["branch", "step", "kind", ...data.quantities.map((q) => q.name)];
  const rows = marks.map(({ b, m }) => [b.name, b.steps[m.point], words(m), ...b.values.map((v) => v[m.point])]);
  section(
    "Limit, bifurcation and Hopf points",
    table(columns, rows, {
      onClick: (i) => goTo({ branch: marks[i].b.number, length: marks[i].b.values[1][marks[i].m.point], step: marks[i].b.steps[marks[i].m.point] }),
    }),
  ).id = "points";
}

function branchesSection() {
  if (data.branches.length < 2 || !data.summary) return;
  const rows = data.summary.branches.map((b, i) => [b.stage ? `${i} ${b.stage}` : i, b.parent, b.imperfection, b.end === "path" ? b.ended : b.end, b.why, b.steps, b.load_factor]);
  section("Branches", table(["branch", "from", "imperfection", "end", "why", "steps", "load factor"], rows));
  if (data.summary.branches_complete === false)
    document.body.lastChild.append(element("p", { class: "note" }, "Branches were left out (branch_depth, branch_count), or points were not found (the table of steps)."));
}

function stepsSection() {
  const { columns, rows, terms } = data.steps;
  if (rows.length === 0) return;
  const at = (name) => columns.indexOf(name);
  const box = section("Steps");
  const radius = element("div", { class: "plot", id: "radius-plot" }),
    decay = element("div", { class: "plot", id: "decay-plot" });
  const title = element("h3");
  box.append(
    element(
      "div",
      { class: "pair" },
      element("div", {}, element("h3", {}, "Radius of the series (thick), length of the step (thin)"), radius),
      element("div", {}, title, decay),
    ),
  );
  const radii = new Chart(radius, {
    height: 260,
    logY: true,
    dots: true,
    onClick: (c, i) => choose(i),
    onHover: (c, i) => columns.map((n, k) => `${n} = ${shown(rows[i][k])}`).join("\n"),
  });
  const terms_ = new Chart(decay, { height: 260, logY: true, dots: true });
  const number = rows.map((_, i) => i + 1),
    positive = (v) => (v > 0 ? v : null);
  radii.set({
    xLabel: "step, all branches in turn",
    yLabel: "radius and length",
    curves: [
      { colour: colourOf(0), x: number, y: rows.map((r) => positive(r[at("radius")])) },
      { colour: colourOf(1), x: number, y: rows.map((r) => positive(r[at("length")])), stability: rows.map(() => "unknown") },
    ],
  });
  const list = table(columns, rows, { onClick: (i) => choose(i) });
  list.id = "steps";
  box.append(list);
  function draw(i) {
    title.textContent = `Terms of the series of step ${rows[i][at("step")]} at its end`;
    const t = terms[i] || [];
    terms_.set({ xLabel: "order k", yLabel: "|U_k| length^k", curves: [{ colour: colourOf(2), x: t.map((_, k) => k + 1), y: t.map(positive) }] });
    radii.choose(0, i);
    list.choose(i);
  }
  function choose(i) {
    goTo({ branch: rows[i][at("branch")], length: rows[i][at("path_length")], step: rows[i][at("step")] });
  }
  watchPlace((to) => {
    let best = -1;
    rows.forEach((r, i) => {
      if (
        r[at("branch")] === to.branch &&
        (best < 0 || Math.abs(r[at("path_length")] - to.length) < Math.abs(rows[best][at("path_length")] - to.length))
      )
        best = i;
    });
    if (best >= 0) draw(best);
  });
  draw(0);
}

function timeSection() {
  const seconds = data.summary?.seconds;
  if (!seconds) return;
  const parts = Object.entries(seconds).filter(([name]) => name !== "total");
  const rest = seconds.total - parts.reduce((sum, [, value]) => sum + value, 0);
  parts.push(["other", Math.max(0, rest)]);
  const bars = parts.map(([name, value]) => {
    const bar = element("div", { class: "fill" });
    bar.style.width = `${seconds.total > 0 ? (100 * value) / seconds.total : 0}%`;
    return element(
      "div",
      { class: "part" },
      element("span", {}, name.replace(/_/g, " ")),
      element("div", { class: "bar" }, bar),
      element("span", {}, `${shown(value, 3)} s`),
    );
  });
  const counts = ["steps", "factorizations", "solves", "orders_computed", "unknowns", "solver", "ranks", "threads"];
  section(
    "Time",
    element("div", { id: "time" }, ...bars),
    table(
      ["what", "number"],
      counts.filter((c) => c in data.summary).map((c) => [c.replace(/_/g, " "), data.summary[c]]),
    ),
  );
}

function eventsSection() {
  if (!data.events || data.events.rows.length === 0) return;
  const { columns, rows } = data.events;
  const at = (name) => columns.indexOf(name);
  section(
    "Contact events",
    table(columns, rows, { onClick: (i) => goTo({ branch: rows[i][at("branch")], length: rows[i][at("path_length")], step: rows[i][at("step")] }) }),
  ).id = "events";
}

function licencesSection() {
  document.body.append(
    element("details", { class: "licences" }, element("summary", {}, "libraries in this page and their licences"), element("pre", {}, data.licences)),
  );
}

function deckSection() {
  if (data.deck)
    section("Deck", element("details", {}, element("summary", {}, data.summary?.deck || "deck"), element("pre", { id: "deck" }, data.deck)));
}

document.head.append(element("style", {}, style));
head();
pathSection();
if (data.shape) showShape(section(data.shape.moves ? "Deformed shape" : "Body"));
pointsSection();
branchesSection();
stepsSection();
eventsSection();
timeSection();
deckSection();
licencesSection();
document.body.dataset.ready = "yes";
