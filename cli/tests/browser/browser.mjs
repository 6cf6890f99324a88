// Controls a headless browser, which opens pages from disk and records every error.
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import { readdirSync } from "node:fs";
import assert from "node:assert/strict";
import path from "node:path";

const modules = process.env.LEXIBUS_BROWSER_MODULES ?? new URL("../../../target/browser", import.meta.url).pathname;
const load = createRequire(path.join(modules, "from-here.js"));
const { chromium } = load("playwright-core");

// Source code of axe-core, which is run within a page.
export const axe = load("axe-core").source;

// Returns the paths of the pages of a site, except those that only lead to the newest revision.
export function pagesOf(site) {
  const all = readdirSync(site, { recursive: true }).map((file) => file.split(path.sep).join("/"));
  return all.filter((file) => file.endsWith(".html") && !file.includes("/latest/")).sort();
}

// Returns all elements of `list` in the full lane, and every `step`-th element in the fast lane.
export function sampled(list, step) {
  return list.filter((_, at) => process.env.LEXIBUS_LANE === "full" || at % step === 0);
}

// These options disable background requests and the graphics card.
const FLAGS = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

// Runs `work` with a browser that has an empty profile. The browser is always closed.
export async function withBrowser(work) {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || await inPath("chromium"), args: FLAGS });
  try {
    return await work(browser);
  } finally {
    await browser.close();
  }
}

async function inPath(program) {
  const { access, constants } = await import("node:fs/promises");
  for (const folder of (process.env.PATH ?? "").split(path.delimiter)) {
    const file = path.join(folder, program);
    if (await access(file, constants.X_OK).then(() => true, () => false)) return file;
  }
  throw new Error(`no ${program} in PATH`);
}

// A browser window for the pages of one site. The pages share their storage.
export class Window {
  static async open(browser, site, options = {}) {
    const opened = new Window();
    opened.site = path.resolve(site);
    opened.root = pathToFileURL(opened.site + path.sep).href;
    // Requests for other addresses are recorded and blocked.
    opened.context = await browser.newContext({ viewport: { width: 1280, height: 800 }, offline: true, ...options });
    opened.context.setDefaultTimeout(60_000);
    opened.complaints = [];
    opened.requests = [];
    opened.#watch();
    opened.page = await opened.context.newPage();
    return opened;
  }

  #watch() {
    const complain = (text) => this.complaints.push(text);
    this.context.on("request", (request) => {
      this.requests.push(request.url());
      if (!request.url().startsWith(this.root)) complain(`requests ${request.url()}`);
    });
    // A browser aborts a request only if the page is left before the file is loaded, for example the index of the search.
    this.context.on("requestfailed", (request) => {
      const error = request.failure()?.errorText;
      if (error !== "net::ERR_ABORTED") complain(`failed to load ${request.url()}: ${error}`);
    });
    this.context.on("console", (message) => {
      if (!["log", "info", "debug"].includes(message.type())) complain(`console: ${message.text()}`);
    });
    this.context.on("weberror", (error) => complain(`a script error: ${error.error()}`));
    this.context.on("dialog", (dialog) => { complain(`a dialog: ${dialog.message()}`); dialog.dismiss(); });
    this.context.on("page", (page) => {
      page.on("crash", () => complain("the page crashed"));
      page.on("download", (download) => complain(`a download of ${download.url()}`));
      if (this.page) complain(`another window: ${page.url()}`);
    });
  }

  // Opens a page of the site by its path, which may have a fragment. An empty page is opened first, because a new fragment alone does not reload a page.
  async go(place) {
    await this.page.goto("about:blank");
    await this.page.goto(this.root + place, { waitUntil: "load" });
    return this.page;
  }

  // Types a text into the search field and returns the results. Waits until results of the whole index or the message `Nothing found.` are shown.
  async search(text) {
    const { page } = this;
    await page.keyboard.press("Escape");
    await page.keyboard.press("/");
    await page.keyboard.press("ControlOrMeta+A");
    await page.keyboard.type(text);
    await page.waitForFunction(() => isLoaded && document.querySelector("#found li") || document.querySelector(".search [role=status]").textContent);
    return page.locator("#found li").allTextContents();
  }

  // Fails if an error was recorded.
  clean() {
    assert.deepEqual(this.complaints, []);
  }

  // Returns the path of the open page relative to the site.
  get place() {
    return decodeURIComponent(this.page.url().slice(this.root.length));
  }

  async close() {
    await this.context.close();
  }
}
