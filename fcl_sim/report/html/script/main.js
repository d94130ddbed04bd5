// The page: every scenario is drawn, the nearest first; where the page is live, it follows what is saved.

const explorers = new Map();

/** Draw the scenarios of the page one after the other; `memories` are the states of those they replace. */
async function drawAll(memories) {
  for (const place of document.querySelectorAll(".explorer")) {
    const text = place.parentNode.querySelector(".pack").textContent;
    const { name } = place.dataset;
    const pack = await unpacked(text);
    explorers.set(name, new Explorer(place, pack, memories.get(name)));
    await new Promise((done) => setTimeout(done));
  }
  document.body.dataset.ready = "";
}

/** Follow a server that tells when something was saved: the page is fetched anew, what was chosen stays. */
function follow() {
  const banner = html("p", { class: "banner off", role: "status" });
  document.body.prepend(banner);
  const source = new EventSource(`events?${document.body.dataset.live}`);
  source.addEventListener("changed", () => {
    banner.classList.add("off");
    refresh();
  });
  source.addEventListener("broken", (event) => {
    say(banner, JSON.parse(event.data));
    banner.classList.remove("off");
  });
  source.addEventListener("ended", () => {
    source.close();
    say(banner, "fcl-sim has ended: the page stays as it is.");
    banner.classList.remove("off");
  });
  const refresh = async () => {
    const fresh = new DOMParser().parseFromString(await (await fetch("")).text(), "text/html");
    const memories = new Map([...explorers].map(([name, explorer]) => [name, explorer.memory()]));
    const top = window.scrollY;
    explorers.clear();
    for (const part of ["main", "nav"]) document.querySelector(part).replaceWith(fresh.querySelector(part));
    document.title = fresh.title;
    await drawAll(memories);
    window.scrollTo({ top, behavior: "instant" });
    document.body.dataset.seen = Number(document.body.dataset.seen || 0) + 1;
  };
}

async function begin() {
  if (typeof DecompressionStream === "undefined") {
    for (const place of document.querySelectorAll(".explorer")) {
      place.append(html("p", { class: "ending" }, "This browser is too old to show signals (it lacks DecompressionStream)."));
    }
    return;
  }
  await drawAll(new Map());
  if ("live" in document.body.dataset) follow();
}

begin();
