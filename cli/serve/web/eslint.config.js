// Which mistakes eslint looks for in the page's own modules and their tests. Run by scripts/lint-web.
import js from "@eslint/js";

const browser = [
  "document",
  "window",
  "location",
  "history",
  "localStorage",
  "navigator",
  "matchMedia",
  "fetch",
  "URL",
  "URLSearchParams",
  "WebSocket",
  "ImageData",
  "Blob",
  "Path2D",
  "ResizeObserver",
  "HTMLElement",
  "Image",
  "Option",
  "HTMLInputElement",
  "HTMLSelectElement",
  "HTMLButtonElement",
  "HTMLCanvasElement",
  "HTMLDialogElement",
  "HTMLFormElement",
  "HTMLDetailsElement",
  "FormData",
  "Event",
  "KeyboardEvent",
  "EventTarget",
  "AbortController",
  "MessageChannel",
  "addEventListener",
  "requestAnimationFrame",
  "devicePixelRatio",
  "setTimeout",
  "clearTimeout",
  "getComputedStyle",
  "getSelection",
  "performance",
  "console",
];
const node = ["process", "Buffer", "console", "URL", "setTimeout"];
const globals = (/** @type {string[]} */ names) => Object.fromEntries(names.map((name) => [name, "readonly"]));

export default [
  { ignores: ["**/vendor/**"] },
  js.configs.recommended,
  {
    rules: {
      eqeqeq: "error",
      "no-var": "error",
      "prefer-const": "error",
      "one-var": ["error", "never"],
      curly: ["error", "multi-line"],
      "no-shadow": "error",
      "no-implicit-globals": "error",
      "no-unused-expressions": "error",
      "max-lines": ["error", 400],
      "no-unused-vars": ["error", { argsIgnorePattern: "^_", caughtErrors: "none" }],
      "max-lines-per-function": ["error", 60],
      "max-params": ["error", 5],
    },
  },
  { files: ["cli/serve/page/**/*.js"], languageOptions: { globals: globals(browser) } },
  // What a test evaluates runs in the page.
  {
    files: ["tests/live/*.mjs", "benchmarks/live/*.mjs", "cli/serve/web/*.js"],
    languageOptions: { globals: globals([...node, ...browser]) },
  },
];
