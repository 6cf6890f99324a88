// Whether there is a browser that can be steered; if not, why.
try {
  const { withBrowser } = await import("./browser.mjs");
  await withBrowser((browser) => console.log(`Chromium ${browser.version()}`));
} catch (error) {
  console.error(error.message.split("\n")[0]);
  process.exitCode = 1;
}
