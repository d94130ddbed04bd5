// The page: every scenario is drawn, the nearest first; where the page is live, it follows what is saved.

const explorers = new Map();
const sources = new Map();

/** Draw the scenarios of the page one after the other; `memories` are the states of those they replace. */
async function drawAll(memories) {
  for (const section of document.querySelectorAll(".scenario")) {
    const place = section.querySelector(".explorer");
    const { name } = place.dataset;
    if (explorers.has(name)) continue;
    sources.set(name, section.outerHTML);
    const pack = await unpacked(section.querySelector(".pack").textContent);
    explorers.set(name, new Explorer(place, pack, memories.get(name)));
    await new Promise((done) => setTimeout(done));
  }
  document.body.dataset.ready = "";
}

/** Put what is drawn already into a page that was fetched, where it tells the same; forget the rest. */
function keepIn(fresh) {
  const kept = new Set();
  for (const section of fresh.querySelectorAll(".scenario")) {
    const { name } = section.querySelector(".explorer").dataset;
    if (sources.get(name) !== section.outerHTML) continue;
    section.replaceWith(explorers.get(name).place.closest(".scenario"));
    kept.add(name);
  }
  for (const name of [...explorers.keys()].filter((each) => !kept.has(each))) explorers.delete(name);
}

const BEFORE = "Below, what this stops is shown as it was before, or not at all.";

/** Follow a server that tells when something was saved: the page is fetched anew, what was chosen stays. */
function follow() {
  const banner = html("p", { class: "banner off", role: "status" });
  document.body.prepend(banner);
  // The banner stays in sight and covers nothing: the page makes room for as much as it takes, none where it is off.
  const room = () => document.documentElement.style.setProperty("--banner", `${banner.offsetHeight}px`);
  new ResizeObserver(room).observe(banner);
  const source = new EventSource(`events?${document.body.dataset.live}`);
  source.addEventListener("changed", () => {
    banner.classList.add("off");
    refresh();
  });
  source.addEventListener("broken", (event) => {
    say(banner, `${JSON.parse(event.data)}\n\n${BEFORE}`);
    banner.classList.remove("off");
  });
  source.addEventListener("ended", () => {
    source.close();
    say(banner, "fcl-sim has ended: the page stays as it is.");
    banner.classList.remove("off");
  });
  let turn = Promise.resolve();
  const refresh = () => {
    turn = turn.then(again).catch(() => {}); // the server has gone, which it tells by itself
  };
  const again = async () => {
    const fresh = new DOMParser().parseFromString(await (await fetch("")).text(), "text/html");
    const memories = new Map([...explorers].map(([name, explorer]) => [name, explorer.memory()]));
    const top = window.scrollY;
    keepIn(fresh);
    for (const part of ["main", "nav"]) document.querySelector(part).replaceWith(fresh.querySelector(part));
    document.title = fresh.title;
    await drawAll(memories);
    window.scrollTo({ top, behavior: "instant" });
    document.body.dataset.seen = Number(document.body.dataset.seen || 0) + 1;
  };
}

/** Let a click on the instant of a miss show it. */
function listen() {
  document.addEventListener("click", (event) => {
    const button = event.target.closest(".jump");
    if (!button) return;
    const { name } = button.closest(".scenario").querySelector(".explorer").dataset;
    const explorer = explorers.get(name);
    if (explorer) explorer.visit(button.dataset.run, Number(button.dataset.time));
  });
}

async function begin() {
  if (typeof DecompressionStream === "undefined") {
    for (const place of document.querySelectorAll(".explorer")) {
      place.append(html("p", { class: "ending" }, "This browser is too old to show signals (it lacks DecompressionStream)."));
    }
    return;
  }
  listen();
  await drawAll(new Map());
  if ("live" in document.body.dataset) follow();
}

begin();
