// Canvas, renderer, light and camera. Draws only when something has changed; between changes nothing runs.
import { Color, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { cssValue } from "../../app/theme.ts";

export class Stage {
  readonly scene = new Scene();
  /** All content, in the sensor's frame: z along the boresight, x right, y down. */
  readonly sensorFrame = new Group();
  readonly camera = new PerspectiveCamera(40, 1, 0.01, 1000);
  readonly renderer: WebGLRenderer;
  /** Called before each drawing. */
  readonly beforeDrawing: (() => void)[] = [];
  private readonly observer: ResizeObserver;
  private readonly box: HTMLElement;
  private request = 0;
  private drawn = 0;

  constructor(box: HTMLElement) {
    this.box = box;
    this.renderer = new WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    const { domElement } = this.renderer;
    domElement.className = "scene-canvas";
    domElement.setAttribute("aria-hidden", "true");
    box.append(domElement);
    this.scene.matrixWorldAutoUpdate = true;
    this.camera.up.set(0, -1, 0);
    const lamp = new DirectionalLight(0xffffff, 1.6);
    lamp.position.set(0.4, 0.8, 1);
    this.camera.add(lamp);
    this.scene.add(this.sensorFrame, this.camera, new HemisphereLight(0xffffff, 0x8090a0, 1.3));
    this.sensorFrame.matrixAutoUpdate = false;
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(box);
    this.resize();
  }

  /** Draws at the next opportunity. */
  readonly invalidate = (): void => {
    if (this.request === 0) this.request = requestAnimationFrame(() => this.draw());
  };

  applyTheme(): void {
    this.scene.background = new Color(cssValue("--stage"));
    this.invalidate();
  }

  /** The picture of now as a PNG. */
  picture(): Promise<Blob | null> {
    this.draw();
    return new Promise((resolve) => this.renderer.domElement.toBlob(resolve, "image/png"));
  }

  get width(): number {
    return this.box.clientWidth;
  }

  get height(): number {
    return this.box.clientHeight;
  }

  destroy(): void {
    cancelAnimationFrame(this.request);
    this.observer.disconnect();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
  }

  /** Draws at once: with what came for this very frame of the screen. */
  draw(): void {
    cancelAnimationFrame(this.request);
    this.request = 0;
    for (const prepare of this.beforeDrawing) prepare();
    this.renderer.render(this.scene, this.camera);
    this.renderer.domElement.dataset.drawn = String(++this.drawn);
  }

  private resize(): void {
    if (this.width === 0 || this.height === 0) return;
    this.renderer.setSize(this.width, this.height);
    this.camera.aspect = this.width / this.height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
