// What the page uses of other people's libraries: `build` makes ../libraries.js of it.
export {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DirectionalLight, DoubleSide, EdgesGeometry, FrontSide, GLSL3, GridHelper, Group,
  HemisphereLight, IntType, LatheGeometry, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshLambertMaterial, NearestFilter, Object3D,
  OrthographicCamera, PerspectiveCamera, Plane, PlaneGeometry, Quaternion, Raycaster, Scene, ShaderMaterial, SphereGeometry, Spherical, Vector2, Vector3, Vector4,
  WebGLRenderer, WebGLRenderTarget,
} from 'three';
export {OrbitControls} from 'three/addons/controls/OrbitControls.js';
export {OBJLoader} from 'three/addons/loaders/OBJLoader.js';
export {STLLoader} from 'three/addons/loaders/STLLoader.js';
export {default as URDFLoader} from 'urdf-loader';
export {default as uPlot} from 'uplot';
