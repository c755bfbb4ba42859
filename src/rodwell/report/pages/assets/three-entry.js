// What viewer.js uses of three.js; bundled into three.min.js, see README.md beside this file.
export {
  ArrowHelper, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, FrontSide, Group, HemisphereLight, Line,
  LineBasicMaterial, Mesh, MeshStandardMaterial, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
