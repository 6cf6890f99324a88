// A headless browser that opens pages from disk, and keeps a list of all that went wrong in it.
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import { readdirSync } from "node:fs";
import assert from "node:assert/strict";
import path from "node:path";

const modules = process.env.LEXIBUS_BROWSER_MODULES ?? new URL("../../../target/browser", import.meta.url).pathname;
const load = createRequire(path.join(modules, "from-here.js"));
const { chromium } = load("playwright-core");

// What axe-core is, as text to be run in a page.
export const axe = load("axe-core").source;

// The pages of a site, by their paths in it.
export function pagesOf(site) {
  const all = readdirSync(site, { recursive: true }).map((own) => own.split(path.sep).join("/"));
  return all.filter((own) => own.endsWith(".html")).sort();
}

// All of `list` in the full lane, one of `step` in the fast lane.
export function sampled(list, step) {
  return list.filter((_, at) => process.env.LEXIBUS_LANE === "full" || at % step === 0);
}

// Neither may it talk to anybody by itself, nor look for a graphics card.
const FLAGS = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

// Runs `work` with a browser of its own, whose profile is new and empty, and ends the browser whatever happens.
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

// Pages of a site that share what the browser keeps, in a window of their own.
export class Window {
  static async open(browser, site, options = {}) {
    const own = new Window();
    own.site = path.resolve(site);
    own.root = pathToFileURL(own.site + path.sep).href;
    // What asks for another place is told, and doesn't get there.
    own.context = await browser.newContext({ viewport: { width: 1280, height: 800 }, offline: true, ...options });
    own.context.setDefaultTimeout(60_000);
    own.complaints = [];
    own.requests = [];
    own.#watch();
    own.page = await own.context.newPage();
    return own;
  }

  #watch() {
    const complain = (text) => this.complaints.push(text);
    this.context.on("request", (request) => {
      this.requests.push(request.url());
      if (!request.url().startsWith(this.root)) complain(`asks for ${request.url()}`);
    });
    this.context.on("requestfailed", (request) => complain(`doesn't get ${request.url()}: ${request.failure()?.errorText}`));
    this.context.on("console", (message) => {
      if (!["log", "info", "debug"].includes(message.type())) complain(`console: ${message.text()}`);
    });
    this.context.on("weberror", (error) => complain(`an error of a script: ${error.error()}`));
    this.context.on("dialog", (dialog) => { complain(`a dialog: ${dialog.message()}`); dialog.dismiss(); });
    this.context.on("page", (page) => {
      page.on("crash", () => complain("the page crashed"));
      page.on("download", (download) => complain(`a download of ${download.url()}`));
      if (this.page) complain(`a further window: ${page.url()}`);
    });
  }

  // Opens a page of the site, by its path in it, an address within the page too. A page that only another address within
  // leads to would not be loaded anew.
  async go(place) {
    await this.page.goto("about:blank");
    await this.page.goto(this.root + place, { waitUntil: "load" });
    return this.page;
  }

  // Types into the search field as people do, from anywhere on the page, and waits for what is found, or for the word that nothing is.
  async search(text) {
    const { page } = this;
    await page.keyboard.press("Escape");
    await page.keyboard.press("/");
    await page.keyboard.press("ControlOrMeta+A");
    await page.keyboard.type(text);
    await page.waitForFunction(() => document.querySelector("#found li") || document.querySelector(".search [role=status]").textContent);
    return page.locator("#found li").allTextContents();
  }

  // Fails where anything went wrong.
  clean() {
    assert.deepEqual(this.complaints, []);
  }

  // The place in the site where the page is.
  get place() {
    return decodeURIComponent(this.page.url().slice(this.root.length));
  }

  async close() {
    await this.context.close();
  }
}
