# SPDX-License-Identifier: MIT
"""Shows a JSON Schema as tables: one for the document, one for each definition that is an
object."""
import json


def type_of(schema):
    """The type in a few words, for example "integer or null", `"rips"` or "list of bar"."""
    if "$ref" in schema:
        return name_of(schema["$ref"])
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{json.dumps(value)}`" for value in schema["enum"])
    if "anyOf" in schema:
        return " or ".join(type_of(one) for one in schema["anyOf"])
    types = schema.get("type", "any")
    types = [types] if isinstance(types, str) else types
    return " or ".join(list_of(schema) if one == "array" else one for one in types)


def list_of(schema):
    if "prefixItems" in schema:
        return "[" + ", ".join(type_of(one) for one in schema["prefixItems"]) + "]"
    number = schema.get("minItems") if schema.get("minItems") == schema.get("maxItems") else None
    return f"list of {f'{number} × ' if number else ''}{type_of(schema.get('items', {}))}"


def name_of(reference):
    return f"*{reference.rpartition('/')[2]}*"


def rows(schema, prefix=""):
    required = schema.get("required", [])
    for name, member in schema["properties"].items():
        about = member.get("description", "")
        if name not in required:
            about = f"optional: {about}" if about else "optional"
        yield f"| `{prefix}{name}` | {type_of(member)} | {about} |"
        inner = member.get("items", member)
        if "properties" in inner:
            yield from rows(inner, f"{prefix}{name}{'[].' if 'items' in member else '.'}")


def table(schema):
    return "\n".join(["| member | is | means |", "|---|---|---|", *rows(schema)]) + "\n"


def tables(schema):
    parts = [table(schema)]
    for name, one in schema.get("$defs", {}).items():
        if "properties" in one:
            parts.append(f"**{name}**: {one['description']}\n\n{table(one)}")
        else:
            parts.append(f"**{name}**: {list_of(one)}{': ' + one['description'] if 'description' in one else ''}\n")
    return "\n".join(parts)
