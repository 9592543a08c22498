// Holds the types of src/lib/documents.ts against documents of the program.
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const file = fileURLToPath(new URL('../src/lib/documents.ts', import.meta.url));
const project = ts.createProgram([file], { strict: true, noEmit: true, module: ts.ModuleKind.ESNext, moduleResolution: ts.ModuleResolutionKind.Bundler });
const checker = project.getTypeChecker();
const source = project.getSourceFile(file);

/** What a value has that its type does not allow, each with its place. */
function differences(value, type, at) {
  if (type.isUnion()) return type.types.some((one) => differences(value, one, at).length === 0) ? [] : [`${at}: ${shown(value)} is not ${checker.typeToString(type)}`];
  const wrong = () => [`${at}: ${shown(value)} is not ${checker.typeToString(type)}`];
  if (type.flags & ts.TypeFlags.Null) return value === null ? [] : wrong();
  if (type.flags & ts.TypeFlags.Undefined) return value === undefined ? [] : wrong();
  if (type.isStringLiteral() || type.isNumberLiteral()) return value === type.value ? [] : wrong();
  if (type.flags & ts.TypeFlags.StringLike) return typeof value === 'string' ? [] : wrong();
  if (type.flags & ts.TypeFlags.NumberLike) return typeof value === 'number' ? [] : wrong();
  if (type.flags & ts.TypeFlags.BooleanLike) return typeof value === 'boolean' && (!(type.flags & ts.TypeFlags.BooleanLiteral) || checker.typeToString(type) === String(value)) ? [] : wrong();
  if (checker.isTupleType(type) || checker.isArrayType(type)) {
    if (!Array.isArray(value)) return wrong();
    const parts = checker.getTypeArguments(type);
    return value.flatMap((one, i) => differences(one, checker.isTupleType(type) ? parts[i] : parts[0], `${at}[${i}]`));
  }
  if (typeof value !== 'object' || value === null) return wrong();
  const index = checker.getIndexInfoOfType(type, ts.IndexKind.String);
  if (index) return Object.entries(value).flatMap(([name, one]) => differences(one, index.type, `${at}.${name}`));
  return checker.getPropertiesOfType(type).flatMap((property) => {
    const isOptional = (property.flags & ts.SymbolFlags.Optional) !== 0;
    if (value[property.name] === undefined) return isOptional ? [] : [`${at}.${property.name} is not there`];
    return differences(value[property.name], checker.getTypeOfSymbolAtLocation(property, source), `${at}.${property.name}`);
  });
}

const shown = (value) => JSON.stringify(value)?.slice(0, 60) ?? 'undefined';

/** The differences between a document and an exported type. */
export function against(name, document) {
  const exported = checker.getExportsOfModule(checker.getSymbolAtLocation(source)).find((one) => one.name === name);
  return differences(document, checker.getDeclaredTypeOfSymbol(exported), name).slice(0, 5);
}
