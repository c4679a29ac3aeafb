// A body as USDZ, for phones without WebXR: one text of USD in an archive that is not packed.

import {COLOURS, filled_kinds, linear, stand} from './place.js';
import {stored_archive} from './archive.js';

/**
 * @param {import('./outline.js').Outline} body
 * @param {{size_m: number, name: string}} of `size_m`: of the grid
 * @returns {Blob} throws an Error with a sentence where nothing stands
 */
export function to_usdz(body, {size_m, name}) {
  const place = stand(body, size_m), kinds = filled_kinds(body);
  const text = `#usda 1.0
(
    defaultPrim = "Body"
    doc = ${JSON.stringify(`${name}, by sculptd`)}
    metersPerUnit = 1
    upAxis = "Y"
)

def Xform "Body" (
    assetInfo = { string name = ${JSON.stringify(name)} }
    kind = "component"
)
{
${kinds.map((kind) => mesh_text(kind, body.edge, place)).join('\n')}
    def Scope "Looks"
    {
${kinds.map(material_text).join('\n')}
    }
}
`;
  return new Blob([stored_archive([['body.usda', new TextEncoder().encode(text)]])], {type: 'model/vnd.usdz+zip'});
}

// Corners that rectangles share are written once; each rectangle has one normal.
function mesh_text({name, corners, sides}, edge, {cell_m, lowest}) {
  const numbers = new Map(), points = [], indices = [];
  const metres = (cells) => Number((cells * cell_m).toFixed(6));
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let at = 0; at < corners.length; at += 3) {
    const [x, y, z] = corners.subarray(at, at + 3), key = x + (edge + 1) * (y + (edge + 1) * z);
    let number = numbers.get(key);
    if (number === undefined) {
      numbers.set(key, number = numbers.size);
      const point = [metres(x - edge / 2), metres(z - lowest), metres(edge / 2 - y)];
      point.forEach((value, axis) => {
        low[axis] = Math.min(low[axis], value);
        high[axis] = Math.max(high[axis], value);
      });
      points.push(`(${point.join(', ')})`);
    }
    indices.push(number);
  }
  const normals = ['(-1, 0, 0)', '(1, 0, 0)', '(0, 0, 1)', '(0, 0, -1)', '(0, -1, 0)', '(0, 1, 0)'];
  return `    def Mesh "${name}" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {
        float3[] extent = [(${low.join(', ')}), (${high.join(', ')})]
        int[] faceVertexCounts = [${Array(sides.length).fill(4).join(', ')}]
        int[] faceVertexIndices = [${indices.join(', ')}]
        normal3f[] normals = [${Array.from(sides, (side) => normals[side]).join(', ')}] (
            interpolation = "uniform"
        )
        point3f[] points = [${points.join(', ')}]
        uniform token subdivisionScheme = "none"
        rel material:binding = </Body/Looks/${name}>
    }
`;
}

function material_text({name}) {
  return `        def Material "${name}"
        {
            token outputs:surface.connect = </Body/Looks/${name}/surface.outputs:surface>
            def Shader "surface"
            {
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor = (${COLOURS[name].map((value) => Number(linear(value).toFixed(4))).join(', ')})
                float inputs:metallic = 0
                float inputs:roughness = 0.9
                token outputs:surface
            }
        }`;
}
