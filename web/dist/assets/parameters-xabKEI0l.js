import{S as e,d as t,f as n,h as r,l as i,p as a,u as o,w as s,x as c}from"./index-Qc_W3yad.js";import{i as l,n as u,r as d,t as f}from"./value-BA77vwhC.js";import{n as p,t as m}from"./files-DqKkerva.js";import{t as h}from"./tab-lKZc--Iv.js";var g=`pulsetrain parameters`,_=1,v=1<<20;function y(e,t,n,r){let i={};for(let t of e.parameters){let e=n[t.id];t.is_setting&&e!==void 0&&(i[t.id]=e)}let a={format:g,version:_,model:e.model,device:t,date:r.toISOString(),parameters:i};return`${JSON.stringify(a,null,2)}\n`}function b(e,t){let n;try{n=JSON.parse(t)}catch(e){return`The file is not JSON: ${e.message}.`}if(!S(n)||n.format!==g)return`The file has no parameters of a controller.`;if(n.version!==_)return`The file is of a newer version of this page.`;if(n.model!==e.model)return`The file is of a ${String(n.model)}, not of a ${e.model}.`;let r=n.parameters;if(!S(r))return`The file has no parameters.`;let i=new Map(e.parameters.map(e=>[e.id,e])),a=new Map,o=[];for(let[e,t]of Object.entries(r)){let n=i.get(e),r=n===void 0?`There is no such parameter.`:n.is_setting?x(n,t):`Not a setting.`;n!==void 0&&r===null?a.set(n,t):o.push(`${e}: ${r}`)}return{device:String(n.device??``),date:String(n.date??``),values:a,problems:o}}function x(e,t){return typeof t==`number`||typeof t==`string`?f(e,t):`Neither a number nor text.`}function S(e){return typeof e==`object`&&!!e&&!Array.isArray(e)}function C(e,t,n){let r=[];for(let i of e.parameters){let e=t.get(i);e!==void 0&&e!==n[i.id]&&r.push({info:i,from:n[i.id],to:e})}return r}var w=class extends h{static properties={...h.properties,values:{state:!0},words:{state:!0},group:{state:!0},only:{state:!0},busy:{state:!0},comparison:{state:!0}};#e=new Map;#t=new Map;#n=new Set;#r=!1;static styles=[a,s`
      .row > select {
        width: auto;
        max-width: 100%;
      }
      .tools {
        position: sticky;
        top: 46px;
        z-index: 2;
        margin-bottom: var(--gap);
      }
      input[type="search"] {
        flex: 1 1 14em;
        width: auto;
      }
      section {
        margin-bottom: var(--gap);
      }
      h2 {
        margin: 0 0 4px;
        font-size: 15px;
      }
      td {
        vertical-align: top;
      }
      td.value {
        width: 210px;
        white-space: nowrap;
      }
      td.value input {
        width: 130px;
        text-align: right;
        font-variant-numeric: tabular-nums;
      }
      td.value input.text {
        text-align: left;
      }
      td.value .problem {
        white-space: normal;
        font-size: 12px;
      }
      td.id {
        width: 110px;
      }
      td.range {
        width: 150px;
      }
      td.default {
        width: 90px;
      }
      td.marks {
        width: 150px;
      }
      td.section {
        width: 60px;
      }
      tr.edited {
        background: var(--busy-bg);
      }
      .what {
        color: var(--muted);
        font-size: 12.5px;
      }
      .diff {
        max-height: 50dvh;
        overflow: auto;
      }
      @media (max-width: 900px) {
        .wide {
          display: none;
        }
        td.value {
          width: auto;
          white-space: normal;
        }
        .tools {
          position: static;
        }
      }
      @media (max-width: 600px) {
        section thead {
          display: none;
        }
        section tr {
          display: grid;
          grid-template-columns: 1fr auto;
          border-bottom: 1px solid var(--line);
        }
        section td {
          width: auto;
          border: 0;
        }
        td.name,
        td.value {
          grid-column: 1 / 3;
        }
        td.marks {
          grid-area: 1 / 2;
        }
      }
    `];constructor(){super(),this.values={},this.words=``,this.group=``,this.only=`all`,this.busy=null,this.comparison=null}willUpdate(e){super.willUpdate(e),this.active&&this.reachable&&!this.#r&&(this.#r=!0,this.#a())}async#i(e,t,n){if(this.busy!==null)return!1;this.busy=e;let r=await o(t,n);return this.busy=null,r}#a(){return this.#i(`Reading…`,()=>this.#o())}async#o(){this.values=await this.api.parameters(this.device.name)}#s(e){return this.#i(`Writing…`,async()=>{let n=0;for(let[t,i]of e)try{await this.api.setParameter(this.device.name,t.id,i),this.#e.delete(t.id),this.#t.delete(t.id),t.stored&&this.#n.add(t.id)}catch(e){n+=1,this.#e.set(t.id,l(t,i)),this.#t.set(t.id,r(e))}if(await this.#o(),n>0)throw Error(`${n} of ${e.size} parameters were not taken; they are marked.`);t(e.size===1?`Written`:`${e.size} parameters written`)})}#c(e,t){let n=this.values[e.id];if(n!==void 0&&t===l(e,n))this.#l(e);else{this.#e.set(e.id,t);let n=u(e,t);n.ok?this.#t.delete(e.id):this.#t.set(e.id,n.problem)}this.requestUpdate()}#l(e){this.#e.delete(e.id),this.#t.delete(e.id),this.requestUpdate()}#u(e){let t=new Map;for(let n of e){let e=this.#e.get(n.id),r=e===void 0?null:u(n,e);r?.ok&&t.set(n,r.value)}return t}#d(e,t){if(e.key===`Enter`){let e=this.#u([t]);e.size>0&&this.usable&&this.#s(e)}if(e.key===`Escape`){this.#l(t);let n=this.values[t.id];e.target.value=n===void 0?``:l(t,n)}}async#f(){await this.#i(`Storing…`,()=>this.api.storeParameters(this.device.name),`Stored`)&&this.#n.clear(),this.requestUpdate()}async#p(){await i({heading:`Restore factory settings?`,text:`Every parameter of ${this.device.name} goes back to its default, stored ones too. This cannot be undone.`,yes:`Restore`,danger:!0})&&await this.#i(`Restoring…`,async()=>{await this.api.restoreFactory(this.device.name);for(let e of[this.#e,this.#t,this.#n])e.clear();await this.#o()},`Factory settings restored`)}async#m(){await this.#i(`Reading…`,async()=>{await this.#o();let e=new Date,t=`${this.device.name}-${e.toISOString().slice(0,10)}.json`;p(t,y(this.catalog,this.device.name,this.values,e),`application/json`)})}async#h(){await o(async()=>{let e=await m(`.json,application/json`,v);if(e===null)return;let t=b(this.catalog,e.text);if(typeof t==`string`)throw Error(t);await this.#o(),this.comparison={name:e.name,file:t,changes:C(this.catalog,t.values,this.values)}})}async#g(e){this.comparison=null,await this.#s(new Map(e.map(({info:e,to:t})=>[e,t])))}#_(e){let t=this.values[e.id];return e.is_setting&&e.default!==null&&t!==void 0&&t!==e.default}#v(){let e=this.words.toLowerCase().split(/\s+/).filter(Boolean);return this.catalog.parameters.filter(t=>{if(this.group!==``&&T(t)!==this.group||this.only===`changed`&&!this.#_(t)||this.only===`unstored`&&!this.#n.has(t.id)||this.only===`edited`&&!this.#e.has(t.id))return!1;let n=`${t.id} ${t.symbol} ${t.name} ${t.text} ${t.unit} ${T(t)}`.toLowerCase();return e.every(e=>n.includes(e))})}render(){let t=this.#v(),n=new Map;for(let e of t)n.set(T(e),[...n.get(T(e))??[],e]);return e`
      ${this.#y(t.length)}
      ${[...n].map(([e,t])=>this.#b(e,t))}
      ${t.length===0?e`<p class="muted">No parameter fits.</p>`:c} ${this.#C()}
    `}#y(t){let n=this.#u(this.catalog.parameters),r=this.busy===null&&this.reachable,i=[...new Set(this.catalog.parameters.map(T))];return e`
      <div class="panel stack tools">
        <div class="row">
          <input
            type="search"
            aria-label="Search parameters"
            placeholder="Search: number, name, words"
            .value=${this.words}
            @input=${e=>this.words=e.target.value}
          />
          <select aria-label="Group" @change=${e=>this.group=e.target.value}>
            <option value="">all groups</option>
            ${i.map(t=>e`<option value=${t} ?selected=${t===this.group}>${t}</option>`)}
          </select>
          <select
            aria-label="Which"
            @change=${e=>this.only=e.target.value}
          >
            <option value="all">all</option>
            <option value="changed">not default</option>
            <option value="unstored">written, not stored</option>
            <option value="edited">typed, not written</option>
          </select>
          <span class="muted">${t} of ${this.catalog.parameters.length}</span>
          <span role="status">${this.busy??c}</span>
        </div>
        <div class="row">
          <button ?disabled=${!r} @click=${()=>this.#a()}>Read all</button>
          <button class="primary" ?disabled=${!r||!this.usable||n.size===0} @click=${()=>this.#s(n)}>
            Write${n.size>0?` ${n.size}`:``}
          </button>
          <button ?disabled=${!r} @click=${()=>this.#m()}>Save to file</button>
          <button ?disabled=${!r||!this.usable} @click=${()=>this.#h()}>Load from file</button>
          <span class="grow"></span>
          <button ?disabled=${!r||!this.usable} @click=${()=>this.#f()}>
            Store${this.#n.size>0?e` <span class="badge warn">${this.#n.size}</span>`:c}
          </button>
          <button class="danger" ?disabled=${!r||!this.usable} @click=${()=>this.#p()}>
            Factory settings
          </button>
        </div>
      </div>
    `}#b(t,r){return e`
      <section class="panel" aria-label=${t}>
        <h2>${t}</h2>
        <table aria-label="Parameters, ${t}">
          <thead>
            <tr>
              <th>Number</th>
              <th>Parameter</th>
              <th>Value</th>
              <th class="wide">Range</th>
              <th class="wide">Default</th>
              <th></th>
              <th class="wide">Manual</th>
            </tr>
          </thead>
          <tbody>
            ${n(r,({id:e})=>e,e=>this.#x(e))}
          </tbody>
        </table>
      </section>
    `}#x(t){let n=this.#e.get(t.id);return e`
      <tr class=${n===void 0?``:`edited`}>
        <td class="id"><code>${t.id}</code></td>
        <td class="name">
          ${t.name}
          <div class="what">${t.text}${t.symbol?e` <code class="wide">${t.symbol}</code>`:c}</div>
        </td>
        <td class="value">${this.#S(t,n)}</td>
        <td class="range wide">${d(t)}</td>
        <td class="default wide">${t.default===null?c:l(t,t.default)}</td>
        <td class="marks">
          ${this.#_(t)?e`<span class="badge busy">not default</span>`:c}
          ${this.#n.has(t.id)?e`<span class="badge warn">not stored</span>`:c}
          ${t.stored&&!this.#n.has(t.id)?e`<span class="badge" title="Kept when the power goes, once it is stored">stored</span>`:c}
        </td>
        <td class="section wide muted">${t.section}</td>
      </tr>
    `}#S(t,n){let r=this.values[t.id],i=n??(r===void 0?``:l(t,r)),a=this.#t.get(t.id),o=t.unit?e` <span class="muted">${t.unit}</span>`:c;return t.writable?e`
      <input
        class=${t.is_text?`text`:``}
        aria-label="${t.name} ${t.id}"
        aria-invalid=${a===void 0?`false`:`true`}
        spellcheck="false"
        autocomplete="off"
        placeholder=${t.readable?``:`write only`}
        .value=${i}
        ?readonly=${!this.usable}
        @input=${e=>this.#c(t,e.target.value)}
        @keydown=${e=>this.#d(e,t)}
      />${o} ${a===void 0?c:e`<div class="problem error-text" role="alert">${a}</div>`}
    `:e`<span class="mono">${i===``?`–`:i}</span>${o}`}#C(){let{name:t,file:n,changes:r}=this.comparison??{};return t===void 0||n===void 0||r===void 0?c:e`
      <pt-dialog wide heading="Parameters of ${t}" .open=${!0} @close=${()=>this.comparison=null}>
        <p class="muted">Saved of ${n.device||`a controller`} ${n.date?`on ${n.date.slice(0,16).replace(`T`,` `)} UTC`:``}.</p>
        <div class="diff">
          ${r.length===0?e`<p>The controller has all of these values already.</p>`:this.#w(r)}
          ${n.problems.map(t=>e`<p class="warn-text">${t}</p>`)}
        </div>
        <button slot="actions" @click=${()=>this.comparison=null}>Cancel</button>
        ${r.length===0?c:e`<button slot="actions" class="primary" @click=${()=>this.#g(r)}>
              Write ${r.length===1?`1 change`:`${r.length} changes`}
            </button>`}
      </pt-dialog>
    `}#w(t){return e`
      <table aria-label="Changes">
        <thead>
          <tr>
            <th>Number</th>
            <th>Parameter</th>
            <th class="number">Now</th>
            <th class="number">In the file</th>
            <th>Unit</th>
          </tr>
        </thead>
        <tbody>
          ${t.map(({info:t,from:n,to:r})=>e`
              <tr>
                <td><code>${t.id}</code></td>
                <td>${t.name}</td>
                <td class="number">${n===void 0?`–`:l(t,n)}</td>
                <td class="number"><strong>${l(t,r)}</strong></td>
                <td class="muted">${t.unit}</td>
              </tr>
            `)}
        </tbody>
      </table>
    `}};customElements.define(`pt-parameters`,w);function T({group:e,axis:t}){return t===null?e:`${e} ${t}`}