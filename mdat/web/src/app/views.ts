// The views of a recording, and where each stands. A further view is a further row.
import type { FunctionComponent } from "preact";
import { EventsView } from "../views/events/events_view.tsx";
import { PlotsView } from "../views/plots/plots_view.tsx";
import { SceneView } from "../views/scene3d/scene_view.tsx";
import { TimelineView } from "../views/timeline/timeline_view.tsx";
import { WhyView } from "../views/why/why_view.tsx";

export type Place = "main" | "side-top" | "side-bottom" | "bottom" | "foot";

export interface ViewEntry {
  id: string;
  title: string;
  place: Place;
  view: FunctionComponent;
}

export const VIEWS: readonly ViewEntry[] = [
  { id: "scene", title: "3D", place: "main", view: SceneView },
  { id: "why", title: "Why", place: "side-top", view: WhyView },
  { id: "events", title: "Events", place: "side-bottom", view: EventsView },
  { id: "plots", title: "Plots", place: "bottom", view: PlotsView },
  { id: "timeline", title: "Time line", place: "foot", view: TimelineView },
];
