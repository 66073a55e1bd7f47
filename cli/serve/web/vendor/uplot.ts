// What the page takes of uPlot: esbuild makes page/vendor/uplot.js of this, and TypeScript takes it for that file's types.
export { default as uPlot } from "uplot";
