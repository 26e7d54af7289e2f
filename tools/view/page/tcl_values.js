// SPDX-License-Identifier: BSD-3-Clause
// Values of posters as the modules print them: lists in Tcl's notation, NAME VALUE NAME VALUE, nested in braces.

/** The elements of a list; an element in braces is without its outer ones. */
function tclElements(text) {
  const elements = [];
  let i = 0;
  while (i < text.length) {
    if (/\s/.test(text[i])) ++i;
    else if (text[i] === "{") {
      const begin = ++i;
      for (let depth = 1; i < text.length; ++i) {
        if (text[i] === "{") ++depth;
        else if (text[i] === "}" && --depth === 0) break;
      }
      elements.push(text.slice(begin, i++));
    } else if (text[i] === '"') {
      const begin = ++i;
      while (i < text.length && text[i] !== '"') i += text[i] === "\\" ? 2 : 1;
      elements.push(text.slice(begin, i++));
    } else {
      const begin = i;
      while (i < text.length && !/\s/.test(text[i])) ++i;
      elements.push(text.slice(begin, i));
    }
  }
  return elements;
}

/** Names and values of a record by its shape; lists are told by their first elements. */
function tclFields(text, shape) {
  if (shape.kind === "record") {
    const elements = tclElements(text),
      shapes = new Map(shape.parts.map((part) => [part.name, part])),
      fields = [];
    for (let i = 0; i + 1 < elements.length; i += 2) {
      const part = shapes.get(elements[i]) ?? {kind: "value"};
      fields.push({
        name: elements[i],
        ...(part.kind === "value" ? {value: elements[i + 1]} : {parts: tclFields(elements[i + 1], part)})
      });
    }
    return fields;
  }
  if (shape.kind === "list") {
    const elements = tclElements(text),
      most = 24,
      part =
        shape.parts.length === 1 && shape.parts[0].kind === "record"
          ? shape.parts[0]
          : {kind: "record", parts: shape.parts};
    const fields = elements.slice(0, most).map((one, i) =>
      /\s/.test(one)
        ? {
            name: String(i),
            value: tclFields(one, part)
              .map((field) => `${field.name} ${field.value ?? "…"}`)
              .join("  ")
          }
        : {name: String(i), value: one}
    );
    return elements.length > most ? [...fields, {name: "…", value: `${elements.length} in all`}] : fields;
  }
  return [{name: "", value: text}];
}

function fieldList(fields) {
  return element(
    "ul",
    {class: "field-list"},
    fields.map((field) =>
      element(
        "li",
        {},
        element("span", {class: "name"}, `${field.name} `),
        field.parts ? fieldList(field.parts) : field.value
      )
    )
  );
}
