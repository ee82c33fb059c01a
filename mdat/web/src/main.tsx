import "uplot/dist/uPlot.min.css";
import "./style.css";
import { render } from "preact";
import { startKeyboard } from "./app/keyboard.ts";
import { tell } from "./app/notices.ts";
import { startRouting } from "./app/route.ts";
import { Shell } from "./app/shell.tsx";
import { startFeed } from "./live/feed.ts";
import { startFollowing } from "./live/follow.ts";

startKeyboard();
startFeed().catch(tell).finally(startRouting);
startFollowing();
render(<Shell />, document.getElementById("page")!);
