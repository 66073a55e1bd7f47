// How the page looks in a real browser, and what outlives it.
import { after, before } from "node:test";

import "./looks.mjs";
import "./results.mjs";
import { startWorld, stopWorld } from "./served_map.mjs";

before(startWorld);
after(stopWorld);
