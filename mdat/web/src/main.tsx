import "uplot/dist/uPlot.min.css";
import "./style.css";
import { render } from "preact";
import { startKeyboard } from "./app/keyboard.ts";
import { startRouting } from "./app/route.ts";
import { Shell } from "./app/shell.tsx";

startKeyboard();
startRouting();
render(<Shell />, document.getElementById("page")!);
