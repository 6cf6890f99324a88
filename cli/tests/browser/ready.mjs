// Checks whether a browser can be controlled. If not, prints the reason.
try {
  const { withBrowser } = await import("./browser.mjs");
  await withBrowser((browser) => console.log(`Chromium ${browser.version()}`));
} catch (error) {
  console.error(error.message.split("\n")[0]);
  process.exitCode = 1;
}
