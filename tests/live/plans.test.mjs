// What the page plans beside single masts, in a real browser: sites, premises, wind turbines.
import { after, before } from "node:test";

import "./sites.mjs";
import "./turbines.mjs";
import { startWorld, stopWorld } from "./served_map.mjs";

before(startWorld);
after(stopWorld);
