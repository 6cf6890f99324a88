// Measures the processor time that a page needs: to show the first result of a search, to answer each further keystroke, and to load a
// page. Other programs change processor time less than elapsed time. Arguments: a site, and optionally the path of a page.
import { Window, withBrowser } from "../cli/tests/browser/browser.mjs";

// Each time is measured so often, and the shortest time counts.
const RUNS = 3;

const QUERIES = ["0x6040", "24640", "control word", "velocità", "target position rpm", "no such thing"];

// Measures the processor time of the main thread of a page.
class Clock {
  static async open(browser, site) {
    const clock = new Clock();
    clock.window = await Window.open(browser, site);
    clock.page = await clock.window.go("index.html");
    clock.session = await clock.window.context.newCDPSession(clock.page);
    await clock.session.send("Performance.enable", { timeDomain: "threadTicks" });
    return clock;
  }

  async now() {
    const { metrics } = await this.session.send("Performance.getMetrics");
    return 1000 * metrics.find(({ name }) => name === "TaskDuration").value;
  }

  // Returns the processor time of an action, and of everything that it starts within 100 ms.
  async time(action) {
    const before = await this.now();
    await action();
    await this.page.waitForTimeout(100);
    return await this.now() - before;
  }

  async close() {
    this.window.clean();
    await this.window.close();
  }
}

const [site, page] = process.argv.slice(2);
await withBrowser(async (browser) => {
  const clock = await Clock.open(browser, site);
  await answers(clock, QUERIES);
  if (page) await loads(clock, page);
  await clock.close();
});

async function shortest(measure) {
  const times = [];
  for (let run = 0; run < RUNS; run++) times.push(await measure());
  return times[0].map((_, at) => Math.min(...times.map((run) => run[at])));
}

// Prints the time until a page is complete and its script has run.
async function loads(clock, place) {
  const [time] = await shortest(async () => {
    await clock.window.go("index.html");
    await clock.page.waitForTimeout(300);
    return [await clock.time(() => clock.window.go(place))];
  });
  console.log(`loading ${place}: ${time.toFixed(0)} ms`);
}

// Prints the times from the first letter to its results, and of each further letter. The browser has loaded the index.
async function answers(clock, queries) {
  const { page } = clock;
  for (const query of queries) {
    const [first, ...others] = await shortest(async () => {
      await clock.window.go("index.html");
      await page.waitForFunction(() => isLoaded);
      await page.waitForTimeout(300);
      await page.keyboard.press("/");
      const times = [];
      for (const letter of query) times.push(await clock.time(() => page.keyboard.type(letter)));
      return times;
    });
    const most = Math.max(...others);
    console.log(`${query}: first letter ${first.toFixed(0)} ms, further letters at most ${most.toFixed(0)} ms`);
  }
}
