// The target's surface: solid at the estimate, its edges at the truth, and a thin mesh at the filter's pose.
import {
  type BufferGeometry,
  Color,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  type Object3D,
} from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import type { FrameInfo, PoseData } from "../../api/types.ts";
import { cssValue } from "../../app/theme.ts";
import { matrixOf } from "./cameras.ts";
import type { LayerName } from "./choice.ts";

const EDGE_DEG = 28;
/** Edges of larger meshes take too long to find: those are drawn as a mesh of lines. */
const MOST_TRIANGLES = 120_000;

type Place = "estimate" | "truth" | "filtered";

function edgesOf(geometry: BufferGeometry): BufferGeometry {
  const triangles = (geometry.index?.count ?? geometry.attributes.position.count) / 3;
  return triangles > MOST_TRIANGLES ? geometry : new EdgesGeometry(geometry, EDGE_DEG);
}

export class Target {
  readonly places: Record<Place, Group> = { estimate: new Group(), truth: new Group(), filtered: new Group() };
  private readonly solid = new MeshLambertMaterial({ polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2, side: 2 });
  private readonly outline = new LineBasicMaterial();
  private readonly truthLine = new LineBasicMaterial();
  private readonly wire = new MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.25 });
  /** Surfaces that a measurement can meet. */
  readonly surfaces: Object3D[] = [];

  constructor(parent: Group) {
    for (const place of Object.values(this.places)) {
      place.matrixAutoUpdate = false;
      place.visible = false;
      parent.add(place);
    }
    this.applyTheme();
  }

  /** Loads the surface; gives the diameter of a sphere about the target's origin that holds it. */
  async load(path: string): Promise<number> {
    const { scene } = await new GLTFLoader().loadAsync(path);
    scene.updateMatrixWorld(true);
    const meshes: Mesh[] = [];
    scene.traverse((node) => {
      if ((node as Mesh).isMesh) meshes.push(node as Mesh);
    });
    let radius_m = 0;
    for (const { geometry, matrixWorld } of meshes) {
      const own = geometry.clone().applyMatrix4(matrixWorld);
      this.add(own);
      own.computeBoundingSphere();
      radius_m = Math.max(radius_m, (own.boundingSphere?.center.length() ?? 0) + (own.boundingSphere?.radius ?? 0));
    }
    return 2 * radius_m;
  }

  applyTheme(): void {
    this.solid.color = new Color(cssValue("--target"));
    this.outline.color = new Color(cssValue("--target-edge"));
    this.truthLine.color = new Color(cssValue("--truth"));
    this.wire.color = new Color(cssValue("--filtered"));
  }

  /** Puts the surface where the frame says; a pose that is not there is not drawn. */
  show(frame: Pick<FrameInfo, "poses">, layers: Pick<Record<LayerName, boolean>, Place>): void {
    this.put("estimate", frame.poses.estimate, layers.estimate);
    this.put("truth", frame.poses.truth, layers.truth);
    this.put("filtered", frame.poses.filtered, layers.filtered);
  }

  private put(name: Place, pose: PoseData | null, wanted: boolean): void {
    const place = this.places[name];
    place.visible = wanted && pose !== null;
    if (pose === null) return;
    place.matrix.copy(matrixOf(pose));
    place.matrixWorldNeedsUpdate = true;
  }

  private add(geometry: BufferGeometry): void {
    if (geometry.attributes.normal === undefined) geometry.computeVertexNormals();
    const surface = new Mesh(geometry, this.solid);
    const edges = edgesOf(geometry);
    this.surfaces.push(surface);
    this.places.estimate.add(surface, new LineSegments(edges, this.outline));
    this.places.truth.add(new LineSegments(edges, this.truthLine));
    this.places.filtered.add(new Mesh(geometry, this.wire));
  }
}
