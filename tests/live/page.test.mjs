// The page of `itin serve` in a real browser, as a planner uses it: all tests on two servers and one browser.
import { after, before } from "node:test";

import "./choices.mjs";
import "./lines.mjs";
import "./masts.mjs";
import { startWorld, stopWorld } from "./served_map.mjs";

before(startWorld);
after(stopWorld);
