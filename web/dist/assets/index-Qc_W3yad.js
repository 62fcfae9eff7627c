var e=`theme`;function t(){let t=localStorage.getItem(e);return t===`dark`||t===`light`?t:`system`}function n(t){t===`system`?localStorage.removeItem(e):localStorage.setItem(e,t),r()}function r(){let e=t();e===`system`?delete document.documentElement.dataset.theme:document.documentElement.dataset.theme=e,window.dispatchEvent(new Event(`theme`))}matchMedia(`(prefers-color-scheme: dark)`).addEventListener(`change`,()=>{window.dispatchEvent(new Event(`theme`))});var i=globalThis,a=i.ShadowRoot&&(i.ShadyCSS===void 0||i.ShadyCSS.nativeShadow)&&`adoptedStyleSheets`in Document.prototype&&`replace`in CSSStyleSheet.prototype,o=Symbol(),s=new WeakMap,c=class{constructor(e,t,n){if(this._$cssResult$=!0,n!==o)throw Error("CSSResult is not constructable. Use `unsafeCSS` or `css` instead.");this.cssText=e,this.t=t}get styleSheet(){let e=this.o,t=this.t;if(a&&e===void 0){let n=t!==void 0&&t.length===1;n&&(e=s.get(t)),e===void 0&&((this.o=e=new CSSStyleSheet).replaceSync(this.cssText),n&&s.set(t,e))}return e}toString(){return this.cssText}},l=e=>new c(typeof e==`string`?e:e+``,void 0,o),u=(e,...t)=>new c(e.length===1?e[0]:t.reduce((t,n,r)=>t+(e=>{if(!0===e._$cssResult$)return e.cssText;if(typeof e==`number`)return e;throw Error(`Value passed to 'css' function must be a 'css' function result: `+e+`. Use 'unsafeCSS' to pass non-literal values, but take care to ensure page security.`)})(n)+e[r+1],e[0]),e,o),d=(e,t)=>{if(a)e.adoptedStyleSheets=t.map(e=>e instanceof CSSStyleSheet?e:e.styleSheet);else for(let n of t){let t=document.createElement(`style`),r=i.litNonce;r!==void 0&&t.setAttribute(`nonce`,r),t.textContent=n.cssText,e.appendChild(t)}},f=a?e=>e:e=>e instanceof CSSStyleSheet?(e=>{let t=``;for(let n of e.cssRules)t+=n.cssText;return l(t)})(e):e,{is:p,defineProperty:m,getOwnPropertyDescriptor:ee,getOwnPropertyNames:te,getOwnPropertySymbols:ne,getPrototypeOf:re}=Object,h=globalThis,ie=h.trustedTypes,ae=ie?ie.emptyScript:``,oe=h.reactiveElementPolyfillSupport,g=(e,t)=>e,se={toAttribute(e,t){switch(t){case Boolean:e=e?ae:null;break;case Object:case Array:e=e==null?e:JSON.stringify(e)}return e},fromAttribute(e,t){let n=e;switch(t){case Boolean:n=e!==null;break;case Number:n=e===null?null:Number(e);break;case Object:case Array:try{n=JSON.parse(e)}catch{n=null}}return n}},ce=(e,t)=>!p(e,t),le={attribute:!0,type:String,converter:se,reflect:!1,useDefault:!1,hasChanged:ce};Symbol.metadata??=Symbol(`metadata`),h.litPropertyMetadata??=new WeakMap;var _=class extends HTMLElement{static addInitializer(e){this._$Ei(),(this.l??=[]).push(e)}static get observedAttributes(){return this.finalize(),this._$Eh&&[...this._$Eh.keys()]}static createProperty(e,t=le){if(t.state&&(t.attribute=!1),this._$Ei(),this.prototype.hasOwnProperty(e)&&((t=Object.create(t)).wrapped=!0),this.elementProperties.set(e,t),!t.noAccessor){let n=Symbol(),r=this.getPropertyDescriptor(e,n,t);r!==void 0&&m(this.prototype,e,r)}}static getPropertyDescriptor(e,t,n){let{get:r,set:i}=ee(this.prototype,e)??{get(){return this[t]},set(e){this[t]=e}};return{get:r,set(t){let a=r?.call(this);i?.call(this,t),this.requestUpdate(e,a,n)},configurable:!0,enumerable:!0}}static getPropertyOptions(e){return this.elementProperties.get(e)??le}static _$Ei(){if(this.hasOwnProperty(g(`elementProperties`)))return;let e=re(this);e.finalize(),e.l!==void 0&&(this.l=[...e.l]),this.elementProperties=new Map(e.elementProperties)}static finalize(){if(this.hasOwnProperty(g(`finalized`)))return;if(this.finalized=!0,this._$Ei(),this.hasOwnProperty(g(`properties`))){let e=this.properties,t=[...te(e),...ne(e)];for(let n of t)this.createProperty(n,e[n])}let e=this[Symbol.metadata];if(e!==null){let t=litPropertyMetadata.get(e);if(t!==void 0)for(let[e,n]of t)this.elementProperties.set(e,n)}this._$Eh=new Map;for(let[e,t]of this.elementProperties){let n=this._$Eu(e,t);n!==void 0&&this._$Eh.set(n,e)}this.elementStyles=this.finalizeStyles(this.styles)}static finalizeStyles(e){let t=[];if(Array.isArray(e)){let n=new Set(e.flat(1/0).reverse());for(let e of n)t.unshift(f(e))}else e!==void 0&&t.push(f(e));return t}static _$Eu(e,t){let n=t.attribute;return!1===n?void 0:typeof n==`string`?n:typeof e==`string`?e.toLowerCase():void 0}constructor(){super(),this._$Ep=void 0,this.isUpdatePending=!1,this.hasUpdated=!1,this._$Em=null,this._$Ev()}_$Ev(){this._$ES=new Promise(e=>this.enableUpdating=e),this._$AL=new Map,this._$E_(),this.requestUpdate(),this.constructor.l?.forEach(e=>e(this))}addController(e){(this._$EO??=new Set).add(e),this.renderRoot!==void 0&&this.isConnected&&e.hostConnected?.()}removeController(e){this._$EO?.delete(e)}_$E_(){let e=new Map,t=this.constructor.elementProperties;for(let n of t.keys())this.hasOwnProperty(n)&&(e.set(n,this[n]),delete this[n]);e.size>0&&(this._$Ep=e)}createRenderRoot(){let e=this.shadowRoot??this.attachShadow(this.constructor.shadowRootOptions);return d(e,this.constructor.elementStyles),e}connectedCallback(){this.renderRoot??=this.createRenderRoot(),this.enableUpdating(!0),this._$EO?.forEach(e=>e.hostConnected?.())}enableUpdating(e){}disconnectedCallback(){this._$EO?.forEach(e=>e.hostDisconnected?.())}attributeChangedCallback(e,t,n){this._$AK(e,n)}_$ET(e,t){let n=this.constructor.elementProperties.get(e),r=this.constructor._$Eu(e,n);if(r!==void 0&&!0===n.reflect){let i=(n.converter?.toAttribute===void 0?se:n.converter).toAttribute(t,n.type);this._$Em=e,i==null?this.removeAttribute(r):this.setAttribute(r,i),this._$Em=null}}_$AK(e,t){let n=this.constructor,r=n._$Eh.get(e);if(r!==void 0&&this._$Em!==r){let e=n.getPropertyOptions(r),i=typeof e.converter==`function`?{fromAttribute:e.converter}:e.converter?.fromAttribute===void 0?se:e.converter;this._$Em=r;let a=i.fromAttribute(t,e.type);this[r]=a??this._$Ej?.get(r)??a,this._$Em=null}}requestUpdate(e,t,n,r=!1,i){if(e!==void 0){let a=this.constructor;if(!1===r&&(i=this[e]),n??=a.getPropertyOptions(e),!((n.hasChanged??ce)(i,t)||n.useDefault&&n.reflect&&i===this._$Ej?.get(e)&&!this.hasAttribute(a._$Eu(e,n))))return;this.C(e,t,n)}!1===this.isUpdatePending&&(this._$ES=this._$EP())}C(e,t,{useDefault:n,reflect:r,wrapped:i},a){n&&!(this._$Ej??=new Map).has(e)&&(this._$Ej.set(e,a??t??this[e]),!0!==i||a!==void 0)||(this._$AL.has(e)||(this.hasUpdated||n||(t=void 0),this._$AL.set(e,t)),!0===r&&this._$Em!==e&&(this._$Eq??=new Set).add(e))}async _$EP(){this.isUpdatePending=!0;try{await this._$ES}catch(e){Promise.reject(e)}let e=this.scheduleUpdate();return e!=null&&await e,!this.isUpdatePending}scheduleUpdate(){return this.performUpdate()}performUpdate(){if(!this.isUpdatePending)return;if(!this.hasUpdated){if(this.renderRoot??=this.createRenderRoot(),this._$Ep){for(let[e,t]of this._$Ep)this[e]=t;this._$Ep=void 0}let e=this.constructor.elementProperties;if(e.size>0)for(let[t,n]of e){let{wrapped:e}=n,r=this[t];!0!==e||this._$AL.has(t)||r===void 0||this.C(t,void 0,n,r)}}let e=!1,t=this._$AL;try{e=this.shouldUpdate(t),e?(this.willUpdate(t),this._$EO?.forEach(e=>e.hostUpdate?.()),this.update(t)):this._$EM()}catch(t){throw e=!1,this._$EM(),t}e&&this._$AE(t)}willUpdate(e){}_$AE(e){this._$EO?.forEach(e=>e.hostUpdated?.()),this.hasUpdated||(this.hasUpdated=!0,this.firstUpdated(e)),this.updated(e)}_$EM(){this._$AL=new Map,this.isUpdatePending=!1}get updateComplete(){return this.getUpdateComplete()}getUpdateComplete(){return this._$ES}shouldUpdate(e){return!0}update(e){this._$Eq&&=this._$Eq.forEach(e=>this._$ET(e,this[e])),this._$EM()}updated(e){}firstUpdated(e){}};_.elementStyles=[],_.shadowRootOptions={mode:`open`},_[g(`elementProperties`)]=new Map,_[g(`finalized`)]=new Map,oe?.({ReactiveElement:_}),(h.reactiveElementVersions??=[]).push(`2.1.2`);var v=globalThis,ue=e=>e,y=v.trustedTypes,de=y?y.createPolicy(`lit-html`,{createHTML:e=>e}):void 0,fe=`$lit$`,b=`lit$${Math.random().toFixed(9).slice(2)}$`,pe=`?`+b,me=`<${pe}>`,x=document,S=()=>x.createComment(``),C=e=>e===null||typeof e!=`object`&&typeof e!=`function`,w=Array.isArray,he=e=>w(e)||typeof e?.[Symbol.iterator]==`function`,T=`[ 	
\f\r]`,E=/<(?:(!--|\/[^a-zA-Z])|(\/?[a-zA-Z][^>\s]*)|(\/?$))/g,ge=/-->/g,_e=/>/g,D=RegExp(`>|${T}(?:([^\\s"'>=/]+)(${T}*=${T}*(?:[^ \t\n\f\r"'\`<>=]|("|')|))|$)`,`g`),ve=/'/g,ye=/"/g,be=/^(?:script|style|textarea|title)$/i,xe=e=>(t,...n)=>({_$litType$:e,strings:t,values:n}),O=xe(1),Se=xe(2),k=Symbol.for(`lit-noChange`),A=Symbol.for(`lit-nothing`),Ce=new WeakMap,j=x.createTreeWalker(x,129);function we(e,t){if(!w(e)||!e.hasOwnProperty(`raw`))throw Error(`invalid template strings array`);return de===void 0?t:de.createHTML(t)}var Te=(e,t)=>{let n=e.length-1,r=[],i,a=t===2?`<svg>`:t===3?`<math>`:``,o=E;for(let t=0;t<n;t++){let n=e[t],s,c,l=-1,u=0;for(;u<n.length&&(o.lastIndex=u,c=o.exec(n),c!==null);)u=o.lastIndex,o===E?c[1]===`!--`?o=ge:c[1]===void 0?c[2]===void 0?c[3]!==void 0&&(o=D):(be.test(c[2])&&(i=RegExp(`</`+c[2],`g`)),o=D):o=_e:o===D?c[0]===`>`?(o=i??E,l=-1):c[1]===void 0?l=-2:(l=o.lastIndex-c[2].length,s=c[1],o=c[3]===void 0?D:c[3]===`"`?ye:ve):o===ye||o===ve?o=D:o===ge||o===_e?o=E:(o=D,i=void 0);let d=o===D&&e[t+1].startsWith(`/>`)?` `:``;a+=o===E?n+me:l>=0?(r.push(s),n.slice(0,l)+fe+n.slice(l)+b+d):n+b+(l===-2?t:d)}return[we(e,a+(e[n]||`<?>`)+(t===2?`</svg>`:t===3?`</math>`:``)),r]},M=class e{constructor({strings:t,_$litType$:n},r){let i;this.parts=[];let a=0,o=0,s=t.length-1,c=this.parts,[l,u]=Te(t,n);if(this.el=e.createElement(l,r),j.currentNode=this.el.content,n===2||n===3){let e=this.el.content.firstChild;e.replaceWith(...e.childNodes)}for(;(i=j.nextNode())!==null&&c.length<s;){if(i.nodeType===1){if(i.hasAttributes())for(let e of i.getAttributeNames())if(e.endsWith(fe)){let t=u[o++],n=i.getAttribute(e).split(b),r=/([.?@])?(.*)/.exec(t);c.push({type:1,index:a,name:r[2],strings:n,ctor:r[1]===`.`?De:r[1]===`?`?Oe:r[1]===`@`?ke:F}),i.removeAttribute(e)}else e.startsWith(b)&&(c.push({type:6,index:a}),i.removeAttribute(e));if(be.test(i.tagName)){let e=i.textContent.split(b),t=e.length-1;if(t>0){i.textContent=y?y.emptyScript:``;for(let n=0;n<t;n++)i.append(e[n],S()),j.nextNode(),c.push({type:2,index:++a});i.append(e[t],S())}}}else if(i.nodeType===8){if(i.data===pe)c.push({type:2,index:a});else{let e=-1;for(;(e=i.data.indexOf(b,e+1))!==-1;)c.push({type:7,index:a}),e+=b.length-1}}a++}}static createElement(e,t){let n=x.createElement(`template`);return n.innerHTML=e,n}};function N(e,t,n=e,r){if(t===k)return t;let i=r===void 0?n._$Cl:n._$Co?.[r],a=C(t)?void 0:t._$litDirective$;return i?.constructor!==a&&(i?._$AO?.(!1),a===void 0?i=void 0:(i=new a(e),i._$AT(e,n,r)),r===void 0?n._$Cl=i:(n._$Co??=[])[r]=i),i!==void 0&&(t=N(e,i._$AS(e,t.values),i,r)),t}var Ee=class{constructor(e,t){this._$AV=[],this._$AN=void 0,this._$AD=e,this._$AM=t}get parentNode(){return this._$AM.parentNode}get _$AU(){return this._$AM._$AU}u(e){let{el:{content:t},parts:n}=this._$AD,r=(e?.creationScope??x).importNode(t,!0);j.currentNode=r;let i=j.nextNode(),a=0,o=0,s=n[0];for(;s!==void 0;){if(a===s.index){let t;s.type===2?t=new P(i,i.nextSibling,this,e):s.type===1?t=new s.ctor(i,s.name,s.strings,this,e):s.type===6&&(t=new Ae(i,this,e)),this._$AV.push(t),s=n[++o]}a!==s?.index&&(i=j.nextNode(),a++)}return j.currentNode=x,r}p(e){let t=0;for(let n of this._$AV)n!==void 0&&(n.strings===void 0?n._$AI(e[t]):(n._$AI(e,n,t),t+=n.strings.length-2)),t++}},P=class e{get _$AU(){return this._$AM?._$AU??this._$Cv}constructor(e,t,n,r){this.type=2,this._$AH=A,this._$AN=void 0,this._$AA=e,this._$AB=t,this._$AM=n,this.options=r,this._$Cv=r?.isConnected??!0}get parentNode(){let e=this._$AA.parentNode,t=this._$AM;return t!==void 0&&e?.nodeType===11&&(e=t.parentNode),e}get startNode(){return this._$AA}get endNode(){return this._$AB}_$AI(e,t=this){e=N(this,e,t),C(e)?e===A||e==null||e===``?(this._$AH!==A&&this._$AR(),this._$AH=A):e!==this._$AH&&e!==k&&this._(e):e._$litType$===void 0?e.nodeType===void 0?he(e)?this.k(e):this._(e):this.T(e):this.$(e)}O(e){return this._$AA.parentNode.insertBefore(e,this._$AB)}T(e){this._$AH!==e&&(this._$AR(),this._$AH=this.O(e))}_(e){this._$AH!==A&&C(this._$AH)?this._$AA.nextSibling.data=e:this.T(x.createTextNode(e)),this._$AH=e}$(e){let{values:t,_$litType$:n}=e,r=typeof n==`number`?this._$AC(e):(n.el===void 0&&(n.el=M.createElement(we(n.h,n.h[0]),this.options)),n);if(this._$AH?._$AD===r)this._$AH.p(t);else{let e=new Ee(r,this),n=e.u(this.options);e.p(t),this.T(n),this._$AH=e}}_$AC(e){let t=Ce.get(e.strings);return t===void 0&&Ce.set(e.strings,t=new M(e)),t}k(t){w(this._$AH)||(this._$AH=[],this._$AR());let n=this._$AH,r,i=0;for(let a of t)i===n.length?n.push(r=new e(this.O(S()),this.O(S()),this,this.options)):r=n[i],r._$AI(a),i++;i<n.length&&(this._$AR(r&&r._$AB.nextSibling,i),n.length=i)}_$AR(e=this._$AA.nextSibling,t){for(this._$AP?.(!1,!0,t);e!==this._$AB;){let t=ue(e).nextSibling;ue(e).remove(),e=t}}setConnected(e){this._$AM===void 0&&(this._$Cv=e,this._$AP?.(e))}},F=class{get tagName(){return this.element.tagName}get _$AU(){return this._$AM._$AU}constructor(e,t,n,r,i){this.type=1,this._$AH=A,this._$AN=void 0,this.element=e,this.name=t,this._$AM=r,this.options=i,n.length>2||n[0]!==``||n[1]!==``?(this._$AH=Array(n.length-1).fill(new String),this.strings=n):this._$AH=A}_$AI(e,t=this,n,r){let i=this.strings,a=!1;if(i===void 0)e=N(this,e,t,0),a=!C(e)||e!==this._$AH&&e!==k,a&&(this._$AH=e);else{let r=e,o,s;for(e=i[0],o=0;o<i.length-1;o++)s=N(this,r[n+o],t,o),s===k&&(s=this._$AH[o]),a||=!C(s)||s!==this._$AH[o],s===A?e=A:e!==A&&(e+=(s??``)+i[o+1]),this._$AH[o]=s}a&&!r&&this.j(e)}j(e){e===A?this.element.removeAttribute(this.name):this.element.setAttribute(this.name,e??``)}},De=class extends F{constructor(){super(...arguments),this.type=3}j(e){this.element[this.name]=e===A?void 0:e}},Oe=class extends F{constructor(){super(...arguments),this.type=4}j(e){this.element.toggleAttribute(this.name,!!e&&e!==A)}},ke=class extends F{constructor(e,t,n,r,i){super(e,t,n,r,i),this.type=5}_$AI(e,t=this){if((e=N(this,e,t,0)??A)===k)return;let n=this._$AH,r=e===A&&n!==A||e.capture!==n.capture||e.once!==n.once||e.passive!==n.passive,i=e!==A&&(n===A||r);r&&this.element.removeEventListener(this.name,this,n),i&&this.element.addEventListener(this.name,this,e),this._$AH=e}handleEvent(e){typeof this._$AH==`function`?this._$AH.call(this.options?.host??this.element,e):this._$AH.handleEvent(e)}},Ae=class{constructor(e,t,n){this.element=e,this.type=6,this._$AN=void 0,this._$AM=t,this.options=n}get _$AU(){return this._$AM._$AU}_$AI(e){N(this,e)}},je={M:fe,P:b,A:pe,C:1,L:Te,R:Ee,D:he,V:N,I:P,H:F,N:Oe,U:ke,B:De,F:Ae},Me=v.litHtmlPolyfillSupport;Me?.(M,P),(v.litHtmlVersions??=[]).push(`3.3.3`);var Ne=(e,t,n)=>{let r=n?.renderBefore??t,i=r._$litPart$;if(i===void 0){let e=n?.renderBefore??null;r._$litPart$=i=new P(t.insertBefore(S(),e),e,void 0,n??{})}return i._$AI(e),i},I=globalThis,L=class extends _{constructor(){super(...arguments),this.renderOptions={host:this},this._$Do=void 0}createRenderRoot(){let e=super.createRenderRoot();return this.renderOptions.renderBefore??=e.firstChild,e}update(e){let t=this.render();this.hasUpdated||(this.renderOptions.isConnected=this.isConnected),super.update(e),this._$Do=Ne(t,this.renderRoot,this.renderOptions)}connectedCallback(){super.connectedCallback(),this._$Do?.setConnected(!0)}disconnectedCallback(){super.disconnectedCallback(),this._$Do?.setConnected(!1)}render(){return k}};L._$litElement$=!0,L.finalized=!0,I.litElementHydrateSupport?.({LitElement:L});var Pe=I.litElementPolyfillSupport;Pe?.({LitElement:L}),(I.litElementVersions??=[]).push(`4.2.2`);var Fe={ATTRIBUTE:1,CHILD:2,PROPERTY:3,BOOLEAN_ATTRIBUTE:4,EVENT:5,ELEMENT:6},R=e=>(...t)=>({_$litDirective$:e,values:t}),z=class{constructor(e){}get _$AU(){return this._$AM._$AU}_$AT(e,t,n){this._$Ct=e,this._$AM=t,this._$Ci=n}_$AS(e,t){return this.update(e,t)}update(e,t){return this.render(...t)}},{I:Ie}=je,Le=e=>e,Re=e=>e.strings===void 0,ze=()=>document.createComment(``),B=(e,t,n)=>{let r=e._$AA.parentNode,i=t===void 0?e._$AB:t._$AA;if(n===void 0)n=new Ie(r.insertBefore(ze(),i),r.insertBefore(ze(),i),e,e.options);else{let t=n._$AB.nextSibling,a=n._$AM,o=a!==e;if(o){let t;n._$AQ?.(e),n._$AM=e,n._$AP!==void 0&&(t=e._$AU)!==a._$AU&&n._$AP(t)}if(t!==i||o){let e=n._$AA;for(;e!==t;){let t=Le(e).nextSibling;Le(r).insertBefore(e,i),e=t}}}return n},V=(e,t,n=e)=>(e._$AI(t,n),e),Be={},Ve=(e,t=Be)=>e._$AH=t,He=e=>e._$AH,Ue=e=>{e._$AR(),e._$AA.remove()},We=R(class extends z{constructor(){super(...arguments),this.key=A}render(e,t){return this.key=e,t}update(e,[t,n]){return t!==this.key&&(Ve(e),this.key=t),n}}),Ge=/^\/api\/(lease|devices\/[^/]+\/(stop|act))$/,H=class extends Error{status;holder;constructor(e,t,n=null){super(t),this.status=e,this.holder=n}};function U(e){return e instanceof Error?e.message:String(e)}var Ke=1e4,qe=/^\/api\/(lease|find|devices\/[^/]+\/(stop|program\/compile))$/,Je=class extends EventTarget{lease=null;beforeChange=null;#e;constructor(e){super(),this.#e=e}get hasToken(){return this.#e!==``}devices(){return this.get(`/api/devices`)}catalog(e){return this.get(`/api/models/${encodeURIComponent(e)}`)}addBench(e){return this.send(`POST`,`/api/devices`,{bench:e})}addReal(e){return this.send(`POST`,`/api/devices`,{real:e})}remove(e){return this.send(`DELETE`,this.path(e))}serialPorts(){return this.get(`/api/serial-ports`)}find(e){return this.send(`POST`,`/api/find`,{link:e},12e4)}status(e){return this.get(this.path(e,`status`))}act(e,t){return this.send(`POST`,this.path(e,`act`),t)}stop(e){return this.send(`POST`,this.path(e,`stop`))}terminal(e,t){return this.send(`POST`,this.path(e,`terminal`),{line:t})}parameters(e){return this.get(this.path(e,`parameters`),6e4)}parameter(e,t){return this.get(this.path(e,`parameters`,t))}setParameter(e,t,n){return this.send(`PUT`,this.path(e,`parameters`,t),n)}storeParameters(e){return this.send(`POST`,this.path(e,`parameters`,`store`))}restoreFactory(e){return this.send(`POST`,this.path(e,`parameters`,`restore`))}variables(e){return this.get(this.path(e,`variables`))}compile(e,t){return this.send(`POST`,this.path(e,`program`,`compile`),{source:t})}download(e,t){return this.send(`PUT`,this.path(e,`program`),{source:t},6e4)}upload(e){return this.get(this.path(e,`program`),6e4)}program(e,t,n){return this.send(`POST`,this.path(e,`programs`,String(t)),{do:n})}setBreakpoints(e,t){return this.send(`PUT`,this.path(e,`debug`),{breakpoints:t})}debug(e,t){return this.send(`POST`,this.path(e,`debug`),{do:t})}machine(e){return this.get(this.path(e,`machine`))}moveSwitches(e,t){return this.send(`PATCH`,this.path(e,`machine`),t)}pin(e,t){return this.get(this.path(e,`pins`,t))}drivePin(e,t,n){return this.send(`PUT`,this.path(e,`pins`,t),n)}releasePin(e,t){return this.send(`DELETE`,this.path(e,`pins`,t))}setLoad(e,t,n){return this.send(`PUT`,this.path(e,`axes`,t,`load`),n)}push(e,t,n){return this.send(`POST`,this.path(e,`axes`,t,`push`),n)}lose(e,t,n){return this.send(`POST`,this.path(e,`axes`,t,`lose`),n)}turnPulser(e,t,n){return this.send(`POST`,this.path(e,`mpg`,t),n)}powerCycle(e){return this.send(`POST`,this.path(e,`power-cycle`))}powerCut(e){return this.send(`POST`,this.path(e,`power-cut`))}faultKinds(){return this.get(`/api/faults`)}faults(e){return this.get(this.path(e,`faults`))}addFault(e,t){return this.send(`POST`,this.path(e,`faults`),t)}clearFault(e,t){return this.send(`DELETE`,this.path(e,`faults`,String(t)))}clearFaults(e){return this.send(`DELETE`,this.path(e,`faults`))}leaseState(){return this.get(`/api/lease`)}takeLease(e,t){return this.send(`POST`,`/api/lease`,{name:e,force:t})}renewLease(){return this.send(`PUT`,`/api/lease`)}dropLease(){return this.send(`DELETE`,`/api/lease`)}path(e,...t){return[`/api/devices`,e,...t].map((e,t)=>t===0?e:encodeURIComponent(e)).join(`/`)}socket(e,t={}){let n=new URL(e,location.href);return n.protocol=n.protocol===`https:`?`wss:`:`ws:`,n.search=new URLSearchParams({...t,token:this.#e}).toString(),new WebSocket(n)}get(e,t=Ke){return this.#t(`GET`,e,void 0,t)}async send(e,t,n,r=Ke){return this.lease===null&&!qe.test(t)&&await this.beforeChange?.(),this.#t(e,t,n,r)}async#t(e,t,n,r){let i={Authorization:`Bearer ${this.#e}`};n!==void 0&&(i[`Content-Type`]=`application/json`),this.lease!==null&&(i[`Control-Lease`]=this.lease);let a;try{a=await fetch(t,{method:e,headers:i,body:n===void 0?null:JSON.stringify(n),signal:AbortSignal.timeout(r),keepalive:Ge.test(t),cache:`no-store`})}catch(e){throw new H(0,e instanceof DOMException&&e.name===`TimeoutError`?`The server did not answer in time.`:`The server cannot be reached.`)}if(!a.ok)throw await this.#n(a);let o=await a.text();return o===``?void 0:JSON.parse(o)}async#n(e){let t=`${e.status} ${e.statusText}`,n=null;try{let r=await e.json();r.error&&(t=r.error),n=r.holder??null}catch{}let r=new H(e.status,t,n);return e.status===401&&this.dispatchEvent(new Event(`unauthorized`)),e.status===423&&this.dispatchEvent(new CustomEvent(`locked`,{detail:n})),r}},Ye=2e3,Xe=class extends EventTarget{holder=null;mine=!1;name;#e;#t=null;constructor(e){super(),this.#e=e,this.name=Ze(),e.beforeChange=()=>this.#n(),e.addEventListener(`locked`,t=>{e.lease=null,this.#a(t.detail,!1)}),window.addEventListener(`pagehide`,()=>void this.release()),this.#i()}async take(){let{lease:e}=await this.#e.takeLease(this.name,!0);this.#e.lease=e,this.#a(this.name,!0)}async release(){if(this.#e.lease===null)return;let e=this.#e.dropLease();this.#e.lease=null,this.#a(null,!1),await e.catch(()=>void 0)}async#n(){(this.holder===null||this.mine)&&(this.#t??=this.#r().finally(()=>{this.#t=null}),await this.#t)}async#r(){try{let{lease:e}=await this.#e.takeLease(this.name,!1);this.#e.lease=e,this.#a(this.name,!0)}catch(e){if(!(e instanceof H))throw e}}async#i(){let{lease:e}=this.#e;try{e!==null&&await this.#e.renewLease();let{holder:t,mine:n}=await this.#e.leaseState();e===this.#e.lease&&(n||(this.#e.lease=null),this.#a(t,n))}catch(t){t instanceof H&&t.status!==0&&e===this.#e.lease&&(this.#e.lease=null)}window.setTimeout(()=>void this.#i(),Ye)}#a(e,t){(e!==this.holder||t!==this.mine)&&(this.holder=e,this.mine=t,this.dispatchEvent(new Event(`change`)))}};function Ze(){let e=sessionStorage.getItem(`page-name`);if(e)return e;let t=navigator.userAgent,n=[`Firefox`,`Edg`,`Chrome`,`Safari`].find(e=>t.includes(e))??`Browser`,r=[`Android`,`iPhone`,`iPad`,`Windows`,`Mac`,`Linux`].find(e=>t.includes(e))??`computer`,i=Math.floor(Math.random()*4096).toString(16).padStart(3,`0`),a=`${n===`Edg`?`Edge`:n} on ${r} (${i})`;return sessionStorage.setItem(`page-name`,a),a}function Qe(e){let[t,n]=e.replace(/^#?\/?/,``).split(`/`).map(e=>{try{return decodeURIComponent(e)}catch{return``}});return{device:t||null,tab:n||null}}function W(e,t=null){return`#/`+[e,t].filter(e=>e!==null).map(encodeURIComponent).join(`/`)}var G=u`
  :host {
    display: block;
  }
  :host([hidden]),
  [hidden] {
    display: none !important;
  }
  *,
  *::before,
  *::after {
    box-sizing: border-box;
  }
  h1,
  h2,
  h3,
  p {
    margin: 0;
  }
  h2 {
    font-size: 13px;
    font-weight: 650;
  }
  h3 {
    font-size: 12px;
    font-weight: 600;
    color: var(--muted);
  }
  a {
    color: var(--accent);
  }
  :focus-visible {
    outline: 2px solid var(--accent);
    outline-offset: 2px;
  }

  button,
  .button {
    display: inline-flex;
    align-items: center;
    justify-content: center;
    gap: 6px;
    min-height: 30px;
    padding: 3px 11px;
    border: 1px solid var(--strong-line);
    border-radius: var(--radius);
    background: var(--raised);
    color: var(--text);
    font: inherit;
    font-weight: 500;
    text-decoration: none;
    white-space: nowrap;
    cursor: pointer;
    touch-action: manipulation;
    user-select: none;
  }
  button:hover:not(:disabled) {
    border-color: var(--accent);
  }
  button:active:not(:disabled),
  button[aria-pressed="true"] {
    background: var(--busy-bg);
    border-color: var(--accent);
    color: var(--accent);
  }
  button:disabled {
    opacity: 0.5;
    cursor: default;
  }
  button.primary {
    background: var(--accent);
    border-color: var(--accent);
    color: var(--on-accent);
  }
  button.danger {
    border-color: var(--error);
    color: var(--error);
  }
  button.stop {
    background: var(--stop);
    border-color: var(--stop);
    color: #fff;
    font-weight: 700;
    letter-spacing: 0.03em;
  }
  button.plain {
    border-color: transparent;
    background: none;
  }
  button.small {
    min-height: 24px;
    padding: 0 8px;
    font-size: 12px;
  }

  input,
  select,
  textarea {
    min-height: 30px;
    padding: 3px 8px;
    border: 1px solid var(--strong-line);
    border-radius: var(--radius);
    background: var(--bg);
    color: var(--text);
    font: inherit;
    font-variant-numeric: tabular-nums;
  }
  input:not([type]),
  input[type="text"],
  input[type="search"],
  select {
    width: 100%;
    min-width: 0;
  }
  input::file-selector-button {
    margin-right: 8px;
    padding: 3px 9px;
    border: 1px solid var(--strong-line);
    border-radius: 4px;
    background: var(--raised);
    color: var(--text);
    font: inherit;
  }
  input.number {
    text-align: right;
  }
  input[type="checkbox"],
  input[type="radio"] {
    min-height: 0;
    width: 16px;
    height: 16px;
    margin: 0;
    accent-color: var(--accent);
  }
  input[type="range"] {
    min-height: 0;
    padding: 0;
    accent-color: var(--accent);
  }
  input:user-invalid,
  input[aria-invalid="true"] {
    border-color: var(--error);
  }
  textarea {
    width: 100%;
    font-family: var(--mono);
    font-size: 13px;
    resize: vertical;
  }
  label {
    display: flex;
    flex-direction: column;
    gap: 2px;
    color: var(--muted);
    font-size: 12px;
  }
  label.line {
    flex-direction: row;
    align-items: center;
    gap: 7px;
    color: var(--text);
    font-size: 14px;
  }
  label input,
  label select,
  label textarea {
    font-size: 14px;
    color: var(--text);
  }
  label textarea {
    font-size: 13px;
  }

  table {
    border-collapse: collapse;
    width: 100%;
  }
  th {
    text-align: left;
    font-weight: 600;
    font-size: 12px;
    color: var(--muted);
  }
  th,
  td {
    padding: 3px 8px;
    border-bottom: 1px solid var(--line);
    vertical-align: baseline;
  }
  td.number,
  th.number {
    text-align: right;
    font-variant-numeric: tabular-nums;
  }

  code,
  .mono {
    font-family: var(--mono);
    font-size: 0.93em;
  }
  .muted {
    color: var(--muted);
  }
  .panel {
    background: var(--panel);
    border: 1px solid var(--line);
    border-radius: 8px;
    padding: 10px 12px;
    min-width: 0;
  }
  .row {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 8px;
  }
  .row.end {
    align-items: flex-end;
  }
  .stack {
    display: flex;
    flex-direction: column;
    gap: var(--gap);
    min-width: 0;
  }
  .grow {
    flex: 1 1 auto;
  }

  .badge {
    display: inline-block;
    padding: 0 8px;
    border-radius: 999px;
    background: var(--raised);
    color: var(--muted);
    font-size: 12px;
    font-weight: 600;
    line-height: 20px;
    white-space: nowrap;
  }
  .badge.ok {
    background: var(--ok-bg);
    color: var(--ok);
  }
  .badge.busy {
    background: var(--busy-bg);
    color: var(--busy);
  }
  .badge.warn {
    background: var(--warn-bg);
    color: var(--warn);
  }
  .badge.error {
    background: var(--error-bg);
    color: var(--error);
  }
  .error-text {
    color: var(--error);
  }
  .warn-text {
    color: var(--warn);
  }

  .visually-hidden {
    position: absolute;
    width: 1px;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
    white-space: nowrap;
  }

  @media (pointer: coarse) {
    button:not(.small),
    input:not([type="checkbox"], [type="radio"], [type="range"]),
    select {
      min-height: 38px;
    }
  }
  @media (prefers-reduced-motion: reduce) {
    * {
      transition: none !important;
      animation: none !important;
    }
  }
`,$e=(e,t,n)=>{let r=new Map;for(let i=t;i<=n;i++)r.set(e[i],i);return r},K=R(class extends z{constructor(e){if(super(e),e.type!==Fe.CHILD)throw Error(`repeat() can only be used in text expressions`)}dt(e,t,n){let r;n===void 0?n=t:t!==void 0&&(r=t);let i=[],a=[],o=0;for(let t of e)i[o]=r?r(t,o):o,a[o]=n(t,o),o++;return{values:a,keys:i}}render(e,t,n){return this.dt(e,t,n).values}update(e,[t,n,r]){let i=He(e),{values:a,keys:o}=this.dt(t,n,r);if(!Array.isArray(i))return this.ut=o,a;let s=this.ut??=[],c=[],l,u,d=0,f=i.length-1,p=0,m=a.length-1;for(;d<=f&&p<=m;)if(i[d]===null)d++;else if(i[f]===null)f--;else if(s[d]===o[p])c[p]=V(i[d],a[p]),d++,p++;else if(s[f]===o[m])c[m]=V(i[f],a[m]),f--,m--;else if(s[d]===o[m])c[m]=V(i[d],a[m]),B(e,c[m+1],i[d]),d++,m--;else if(s[f]===o[p])c[p]=V(i[f],a[p]),B(e,i[d],i[f]),f--,p++;else if(l===void 0&&(l=$e(o,p,m),u=$e(s,d,f)),l.has(s[d])){if(l.has(s[f])){let t=u.get(o[p]),n=t===void 0?null:i[t];if(n===null){let t=B(e,i[d]);V(t,a[p]),c[p]=t}else c[p]=V(n,a[p]),B(e,i[d],n),i[t]=null;p++}else Ue(i[f]),f--}else Ue(i[d]),d++;for(;p<=m;){let t=B(e,c[m+1]);V(t,a[p]),c[p++]=t}for(;d<=f;){let e=i[d++];e!==null&&Ue(e)}return this.ut=o,Ve(e,c),k}}),et={info:4e3,error:9e3},tt=new EventTarget,nt=1;function q(e,t=`info`){tt.dispatchEvent(new CustomEvent(`toast`,{detail:{id:nt++,kind:t,text:e}}))}async function J(e,t){try{return await e(),t&&q(t),!0}catch(e){return q(U(e),`error`),!1}}var rt=class extends L{static properties={shown:{state:!0}};static styles=[G,u`
      :host {
        position: fixed;
        z-index: 30;
        right: 12px;
        bottom: 12px;
        width: min(420px, calc(100vw - 24px));
        pointer-events: none;
      }
      .toast {
        display: flex;
        gap: 8px;
        align-items: flex-start;
        margin-top: 8px;
        padding: 9px 10px 9px 13px;
        border: 1px solid var(--strong-line);
        border-left: 4px solid var(--accent);
        border-radius: var(--radius);
        background: var(--panel);
        box-shadow: 0 4px 18px rgb(0 0 0 / 0.25);
        pointer-events: auto;
        overflow-wrap: anywhere;
      }
      .error {
        border-left-color: var(--error);
      }
      .toast span {
        flex: 1;
      }
      @media (max-width: 700px) {
        :host {
          bottom: 70px;
        }
      }
    `];constructor(){super(),this.shown=[],tt.addEventListener(`toast`,e=>this.#e(e.detail))}#e(e){let t=this.shown.filter(t=>t.text!==e.text);this.shown=[...t,e].slice(-4),window.setTimeout(()=>this.#t(e.id),et[e.kind])}#t(e){this.shown=this.shown.filter(t=>t.id!==e)}render(){return O`
      <div role="status" aria-live="polite">${this.#n(`info`)}</div>
      <div role="alert" aria-live="assertive">${this.#n(`error`)}</div>
    `}#n(e){return K(this.shown.filter(t=>t.kind===e),e=>e.id,t=>O`
        <div class="toast ${e}">
          <span>${e===`error`?O`<strong>Error:</strong> `:``}${t.text}</span>
          <button class="plain small" aria-label="Dismiss" @click=${()=>this.#t(t.id)}>✕</button>
        </div>
      `)}};customElements.define(`pt-toasts`,rt);var it=`stop-motion`,at=class extends L{static properties={heading:{type:String},open:{type:Boolean,reflect:!0},wide:{type:Boolean,reflect:!0}};static styles=[G,u`
      :host {
        display: contents;
      }
      dialog {
        width: min(480px, calc(100vw - 24px));
        max-height: calc(100dvh - 40px);
        padding: 0;
        border: 1px solid var(--strong-line);
        border-radius: 10px;
        background: var(--panel);
        color: var(--text);
        box-shadow: 0 12px 48px rgb(0 0 0 / 0.4);
      }
      :host([wide]) dialog {
        width: min(820px, calc(100vw - 24px));
      }
      dialog::backdrop {
        background: rgb(8 12 16 / 0.55);
      }
      header {
        display: flex;
        align-items: center;
        gap: 8px;
        padding: 12px 10px 12px 16px;
        border-bottom: 1px solid var(--line);
      }
      header h2 {
        flex: 1;
        font-size: 15px;
      }
      .body {
        padding: 14px 16px;
      }
      footer {
        display: flex;
        justify-content: flex-end;
        gap: 8px;
        padding: 0 16px 14px;
      }
    `];constructor(){super(),this.heading=``,this.open=!1,this.wide=!1}updated(){let e=this.renderRoot.querySelector(`dialog`);this.open&&!e.open&&e.showModal(),!this.open&&e.open&&e.close()}render(){return O`
      <dialog aria-labelledby="heading" @close=${this.#e}>
        <header>
          <h2 id="heading">${this.heading}</h2>
          <button class="stop small" type="button" @click=${()=>window.dispatchEvent(new Event(it))}>■ STOP</button>
          <button class="plain small" aria-label="Close" @click=${()=>this.open=!1}>✕</button>
        </header>
        <div class="body"><slot></slot></div>
        <footer><slot name="actions"></slot></footer>
      </dialog>
    `}#e(){this.open=!1,this.dispatchEvent(new Event(`close`))}};customElements.define(`pt-dialog`,at);function ot(e){return new Promise(t=>{let n=document.createElement(`pt-confirm`);Object.assign(n,{question:e,answer:t}),document.body.append(n)})}var st=class extends L{static styles=G;#e=!1;render(){let{heading:e,text:t,yes:n,danger:r}=this.question;return O`
      <pt-dialog .heading=${e} .open=${!0} @close=${this.#n}>
        <p>${t}</p>
        <button slot="actions" @click=${()=>this.#t(!1)}>Cancel</button>
        <button slot="actions" class=${r?`danger`:`primary`} autofocus @click=${()=>this.#t(!0)}>
          ${n}
        </button>
      </pt-dialog>
    `}#t(e){this.#e=e,this.renderRoot.querySelector(`pt-dialog`).open=!1}#n(){this.answer(this.#e),Ne(null,this.renderRoot),this.remove()}};customElements.define(`pt-confirm`,st);var ct=[`position`,`speed`,`encoder`,`delta`,`load`],Y=6500,lt=class{#e=new Float64Array(2*Y);put(e,t){this.#e[e]=t,this.#e[e+Y]=t}view(e,t){return this.#e.subarray(e,e+t)}},ut=class{#e=new lt;#t=new Map;#n=0;#r=0;#i=-1/0;version=0;get length(){return this.#r}get last(){return this.#i}has(e,t){return this.#t.has(`${e} ${t}`)}add(e){let t=Object.entries(e.axes);e.seconds.forEach((e,n)=>{if(e<=this.#i){if(this.#i-e<.5)return;this.clear()}this.#e.put(this.#n,e);for(let[e,r]of t)for(let t of ct){let i=r[t]?.[n];i!=null&&this.#a(e,t).put(this.#n,i)}this.#i=e,this.#n=(this.#n+1)%Y,this.#r=Math.min(this.#r+1,Y)}),this.version+=1}clear(){this.#n=0,this.#r=0,this.#i=-1/0,this.version+=1}time(){return this.#e.view(this.#o(),this.#r)}values(e,t){return this.#a(e,t).view(this.#o(),this.#r)}#a(e,t){let n=`${e} ${t}`,r=this.#t.get(n);return r||(r=new lt,this.#t.set(n,r)),r}#o(){return(this.#n-this.#r+Y)%Y}},dt=2e3,ft=250,pt=5e3,mt=5e3,ht=200,gt=250,_t=class extends EventTarget{name;status=null;link={state:`connecting`};debug={held:null,breakpoints:[]};samples=new ut;traffic=[];connected=!1;statusAt=0;#e;#t=null;#n=ft;#r=0;#i=0;#a=0;#o=!1;#s=new Set;#c=0;constructor(e,t){super(),this.#e=e,this.name=t}open(){this.#o||(this.#o=!0,this.#u())}close(){this.#o=!1,clearTimeout(this.#r),clearTimeout(this.#i),clearTimeout(this.#a),clearInterval(this.#c),this.#t?.close(),this.#t=null}hold(e){this.#s.add(e),this.#l(),this.#c||=window.setInterval(()=>this.#l(),ht)}letGo(e){this.#s.delete(e)&&(this.#l(),this.#s.size>0||(clearInterval(this.#c),this.#c=0))}#l(){if(this.#t?.readyState!==WebSocket.OPEN)return;let{lease:e}=this.#e,t={type:`hold`,axes:[...this.#s],...e===null?{}:{lease:e}};this.#t.send(JSON.stringify(t))}clearTraffic(){this.traffic=[],this.#h(`traffic`)}#u(){let e=this.#e.socket(this.#e.path(this.name,`live`));this.#t=e,e.onopen=()=>{this.#n=ft,this.#p(!0),this.#f()},e.onmessage=e=>{this.#f(),this.#m(JSON.parse(e.data))},e.onclose=()=>this.#d(e)}#d(e){e===this.#t&&(this.#t=null,e.onclose=null,e.close(),clearTimeout(this.#i),this.#p(!1),this.#o&&(this.#r=window.setTimeout(()=>this.#u(),this.#n),this.#n=Math.min(this.#n*2,pt)))}#f(){clearTimeout(this.#i);let e=this.#t;e&&(this.#i=window.setTimeout(()=>this.#d(e),mt))}#p(e){e!==this.connected&&(this.connected=e,this.#h(`connection`))}#m(e){switch(e.type){case`status`:this.status=e.status,this.statusAt=performance.now();break;case`samples`:this.samples.add(e.samples);break;case`traffic`:this.traffic=vt(this.traffic.concat(e.traffic)),this.#a||=window.setTimeout(()=>{this.#a=0,this.#h(`traffic`)},gt);return;case`link`:this.link=e.link;break;case`debug`:this.debug=e.debug}this.#h(e.type)}#h(e){this.dispatchEvent(new Event(e))}};function vt(e){let t=e.length-dt;return t<=0?e:e.filter(({polled:e})=>!e||t--<=0).slice(-2e3)}var yt=(function(){let e=typeof document<`u`&&document.createElement(`link`).relList;return e&&e.supports&&e.supports(`modulepreload`)?`modulepreload`:`preload`})(),bt=function(e){return`/`+e},xt={},St=function(e){return e.pathname.endsWith(`.css`)},Ct=function(e,t,n){if(t in e)return e[t];let r=n();if(!r){e[t]=void 0;return}let i=r.then(()=>{e[t]=void 0},n=>{throw e[t]=void 0,n});return e[t]=i,i},X=function(e,t,n){let r=Promise.resolve();if(t&&t.length>0){let e,i=document.querySelector(`meta[property=csp-nonce]`),a=i?.nonce||i?.getAttribute(`nonce`);function o(e){return Promise.all(e.map(e=>Promise.resolve(e).then(e=>({status:`fulfilled`,value:e}),e=>({status:`rejected`,reason:e}))))}function s(e){return import.meta.resolve?new URL(import.meta.resolve(e)):new URL(e,import.meta.url)}r=o(t.map(t=>{t=bt(t,n);let r=s(t),i=St(r);return Ct(xt,r.href,()=>{if(e===void 0){e={all:new Set,styles:new Set};let t=document.getElementsByTagName(`link`);for(let n=t.length-1;n>=0;n--){let r=t[n];e.all.add(r.href),r.rel===`stylesheet`&&e.styles.add(r.href)}}if((i?e.styles:e.all).has(r.href))return;let t=document.createElement(`link`);if(t.rel=i?`stylesheet`:yt,i||(t.as=`script`),t.crossOrigin=``,t.href=r.href,a&&t.setAttribute(`nonce`,a),document.head.appendChild(t),i)return new Promise((e,n)=>{let i=a=>{t.removeEventListener(`load`,i),t.removeEventListener(`error`,i),a.type===`error`?n(Error(`Unable to preload CSS for ${r}`)):e(a)};t.addEventListener(`load`,i),t.addEventListener(`error`,i)})})}).filter(e=>e!==void 0))}function i(e){let t=new Event(`vite:preloadError`,{cancelable:!0});if(t.payload=e,window.dispatchEvent(t),!t.defaultPrevented)throw e}return r.then(t=>{for(let e of t||[])e.status===`rejected`&&i(e.reason);return e().catch(i)})},wt=[{id:`control`,title:`Control`,element:`pt-control`,load:()=>X(()=>import(`./control-A4C9CEnS.js`),[])},{id:`chart`,title:`Chart`,element:`pt-chart-tab`,load:()=>X(()=>import(`./chart-CGDmk3jV.js`),[])},{id:`io`,title:`I/O`,element:`pt-io`,load:()=>X(()=>import(`./io-B-9ZsJcp.js`),[])},{id:`terminal`,title:`Terminal`,element:`pt-terminal`,load:()=>X(()=>import(`./terminal-Db30v4mu.js`),[])},{id:`parameters`,title:`Parameters`,element:`pt-parameters`,load:()=>X(()=>import(`./parameters-xabKEI0l.js`),[])},{id:`program`,title:`Program`,element:`pt-program`,load:()=>X(()=>import(`./program-DuNFjxzt.js`),[])},{id:`tools`,title:`Tools`,element:`pt-tools`,load:()=>X(()=>import(`./tools-CcMDow10.js`),[])}],Tt=2e3,Et=class extends L{static properties={api:{attribute:!1},control:{attribute:!1},name:{type:String},tab:{type:String},device:{state:!0},problem:{state:!0},loaded:{state:!0}};#e=null;#t=null;#n=new Map;#r=0;#i=()=>this.requestUpdate();#a=()=>{this.requestUpdate(),this.#t?.connected||this.#s()};static styles=[G,u`
      nav {
        display: flex;
        gap: 2px;
        margin-bottom: var(--gap);
        border-bottom: 1px solid var(--line);
        overflow-x: auto;
        scrollbar-width: none;
      }
      nav a {
        padding: 8px 13px;
        border-bottom: 2px solid transparent;
        color: var(--muted);
        text-decoration: none;
        font-weight: 550;
        white-space: nowrap;
      }
      nav a:hover {
        color: var(--text);
      }
      nav a:focus-visible {
        outline-offset: -2px;
      }
      nav a[aria-current] {
        border-bottom-color: var(--accent);
        color: var(--text);
      }
      .banner {
        display: flex;
        align-items: center;
        gap: 10px;
        margin-bottom: var(--gap);
        padding: 8px 12px;
        border-radius: var(--radius);
        background: var(--error-bg);
        color: var(--error);
        font-weight: 550;
      }
      .stale {
        opacity: 0.65;
      }
      .waiting {
        padding: 40px 0;
        text-align: center;
        color: var(--muted);
      }
    `];constructor(){super(),this.name=``,this.tab=null,this.device=null,this.problem=null,this.loaded=null}connectedCallback(){super.connectedCallback(),this.#o()}disconnectedCallback(){super.disconnectedCallback(),clearTimeout(this.#r),this.#t?.close()}async#o(){try{let e=(await this.api.devices()).find(e=>e.name===this.name);if(!e){this.problem=`There is no controller “${this.name}”.`;return}if(this.#e=await this.api.catalog(e.model),!this.isConnected)return;this.#t=new _t(this.api,this.name),this.#t.addEventListener(`connection`,this.#a),this.#t.addEventListener(`link`,this.#i),this.#t.open(),this.problem=null,this.device=e}catch(e){this.problem=U(e),this.isConnected&&(this.#r=window.setTimeout(()=>void this.#o(),Tt))}}async#s(){let e=await this.api.devices().catch(()=>null);e&&!e.some(e=>e.name===this.name)&&(this.#t?.close(),this.problem=`“${this.name}” has been removed.`)}updated(){if(!this.device)return;let e=this.#c();e&&!this.#n.has(e.id)&&this.#u(e);for(let[t,n]of this.#n)n.hidden=t!==e?.id,n.active=t===e?.id}#c(){let e=this.#l();return e.find(e=>e.id===this.tab)??e[0]}#l(){let[e,t]=[this.device,this.#e];return!e||!t?[]:wt.filter(n=>n.fits?.(e,t)??!0)}async#u(e){try{await e.load()}catch{this.problem=`A part of the page could not be loaded; reload the page.`;return}if(this.#n.has(e.id))return;let t=document.createElement(e.element);Object.assign(t,{device:this.device,catalog:this.#e,live:this.#t,api:this.api,control:this.control,active:!0}),this.#n.set(e.id,t),this.loaded=e.id,this.renderRoot.querySelector(`main`).append(t),this.requestUpdate()}render(){if(!this.device)return O`<p class="waiting" role="status">${this.problem??`Loading…`}</p>`;let e=this.#c();return O`
      <nav aria-label="Parts of ${this.name}">
        ${this.#l().map(({id:t,title:n})=>O`
            <a href=${W(this.name,t)} aria-current=${t===e?.id?`page`:A}>${n}</a>
          `)}
      </nav>
      ${this.#d()}
      <main class=${this.#t?.connected?``:`stale`}></main>
    `}#d(){let e=this.#t,t=this.problem?this.problem:e.connected?e.link.state===`lost`?`The controller does not answer: ${e.link.reason}`:null:`The server does not answer. What is shown is old; the page connects again by itself.`;return t?O`<div class="banner" role="alert">${t}</div>`:A}};customElements.define(`pt-controller`,Et);var Dt=new Intl.NumberFormat(`en`,{maximumFractionDigits:0,useGrouping:!0});function Z(e){return e==null||!Number.isFinite(e)?`–`:Dt.format(e).replaceAll(`,`,` `).replace(`-`,`−`)}function Ot(e,t){return e==null||!Number.isFinite(e)?`–`:e.toFixed(t).replace(`-`,`−`)}function kt(e){return e===null||Number.isInteger(e)?Z(e):Ot(Number(e.toFixed(2)),Number.isInteger(e*10)?1:2)}function At(e){let t=Math.floor(e*10),n=e=>String(e).padStart(2,`0`),r=Math.floor(t/10);return`${Math.floor(r/3600)}:${n(Math.floor(r/60)%60)}:${n(r%60)}.${t%10}`}function Q(e){let t=e.replace(/[\s_\u2009]/g,``).replace(`−`,`-`);if(!/^[+-]?(\d+|0[xX][0-9a-fA-F]+)$/.test(t))return null;let n=(t.startsWith(`-`)?-1:1)*Number(t.replace(/^[+-]/,``));return Number.isSafeInteger(n)?n:null}function jt(e){let t=e.replace(/[\s_\u2009]/g,``).replace(`−`,`-`);return/^[+-]?(\d+\.?\d*|\.\d+)$/.test(t)?Number(t):Q(e)}function Mt(e){return e.error===null?e.speed!==0||!/^(idle|standing|off)/i.test(e.state)?`busy`:e.enabled===!1?``:`ok`:`error`}var Nt=`[[device]]
model = "pmx-2ed"
name = "stage"
listen = ["tcp:127.0.0.1:0"]
[device.axis.X]
negative_limit = -20000
positive_limit = 100000
home = [-200, 0]
`,Pt=class extends L{static properties={api:{attribute:!1},kind:{attribute:!1},problem:{state:!0},busy:{state:!0},models:{state:!0},ports:{state:!0},found:{state:!0},link:{state:!0},model:{state:!0}};static styles=[G,u`
      .two {
        display: grid;
        grid-template-columns: 1fr 1fr;
        gap: 10px;
      }
      pre {
        margin: 0;
        white-space: pre-wrap;
        font: 12px/1.5 var(--mono);
      }
    `];constructor(){super(),this.kind=null,this.problem=null,this.busy=!1,this.models=[],this.ports=[],this.found=null,this.link=`serial`,this.model=``}willUpdate(e){e.has(`kind`)&&this.kind!==null&&(this.problem=null,this.found=null,this.kind===`real`&&this.#e())}async#e(){try{[this.models,this.ports]=await Promise.all([this.api.get(`/api/models`),this.api.serialPorts()]),this.model||=this.models[0]?.model??``}catch(e){this.problem=U(e)}}render(){return O`
      <pt-dialog wide .heading=${`Add virtual controllers`} .open=${this.kind===`bench`} @close=${this.#t}>
        ${this.#r()}
      </pt-dialog>
      <pt-dialog .heading=${`Connect a real controller`} .open=${this.kind===`real`} @close=${this.#t}>
        ${this.#o()}
      </pt-dialog>
    `}#t(){this.kind=null,this.dispatchEvent(new Event(`close`))}#n(){return this.problem?O`<pre class="error-text" role="alert">${this.problem}</pre>`:A}#r(){return O`
      <form class="stack" @submit=${this.#a}>
        <p class="muted">A bench file says which controllers there are and what machine stands behind their pins.</p>
        <label>Bench file (TOML)
          <textarea name="bench" rows="12" spellcheck="false" required .defaultValue=${Nt}></textarea>
        </label>
        <label>Or from disk <input type="file" accept=".toml,text/plain" @change=${this.#i} /></label>
        ${this.#n()}
        <div class="row"><span class="grow"></span>
          <button class="primary" ?disabled=${this.busy}>Add</button>
        </div>
      </form>
    `}async#i(e){let t=e.target.files?.[0];t&&(this.renderRoot.querySelector(`textarea[name=bench]`).value=await t.text())}async#a(e){e.preventDefault();let t=String(new FormData(e.target).get(`bench`));await this.#f(()=>this.api.addBench(t),`Added`)}#o(){let e=this.model.startsWith(`pd42`);return O`
      <form class="stack" @submit=${this.#d}>
        <div class="two">
          <label>Name <input name="name" type="text" required maxlength="40" value="machine" /></label>
          <label>Model
            <select name="model" @change=${e=>this.model=e.target.value}>
              ${this.models.map(({model:e,title:t})=>O`
                <option value=${e} ?selected=${e===this.model}>${t}</option>`)}
            </select>
          </label>
        </div>
        <div class="row" role="radiogroup" aria-label="Way to the controller">
          ${[`serial`,`tcp`].map(e=>O`
            <label class="line">
              <input type="radio" name="way" .checked=${this.link===e} @change=${()=>this.link=e} />
              ${e===`serial`?`Serial port`:`TCP`}
            </label>`)}
        </div>
        ${this.link===`serial`?O`
          <div class="two">
            <label>Port
              <input name="port" type="text" list="ports" required placeholder="/dev/ttyUSB0" value=${this.ports[0]??``} />
              <datalist id="ports">${this.ports.map(e=>O`<option value=${e}></option>`)}</datalist>
            </label>
            <label>Bits a second
              <select name="baud">
                ${[9600,19200,38400,57600,115200].map(e=>O`<option>${e}</option>`)}
              </select>
            </label>
          </div>
          <p class="muted">${this.ports.length===0?`The server sees no serial port.`:A}</p>`:O`
          <label>Host and port <input name="host" type="text" required placeholder="192.168.0.10:4001" /></label>`}
        <div class="row end">
          <label class="grow">${e?`Module address`:`RS-485 address, empty on a line of its own`}
            <input name="address" type="text" inputmode="numeric" placeholder=${e?`1`:``} />
          </label>
          <button type="button" ?disabled=${this.busy} @click=${this.#u}>
            ${this.busy?`Searching…`:`Search the bus`}
          </button>
        </div>
        ${this.found?this.#s(this.found):A}
        ${this.#n()}
        <div class="row"><span class="grow"></span>
          <button class="primary" ?disabled=${this.busy}>Connect</button>
        </div>
      </form>
    `}#s(e){return e.length===0?O`<p role="status">Nothing answered: look at the supply, the wires and the speed of the port.</p>`:O`
      <table aria-label="What answered">
        <thead><tr><th class="number">Address</th><th>Model</th><th>Version</th><th></th></tr></thead>
        <tbody>
          ${e.map(e=>O`
            <tr>
              <td class="number">${e.address}</td><td>${e.model??`unknown`}</td><td>${e.version}</td>
              <td><button type="button" class="small" @click=${()=>this.#c(e)}>Use</button></td>
            </tr>`)}
        </tbody>
      </table>
    `}#c(e){this.renderRoot.querySelector(`input[name=address]`).value=String(e.address),e.model&&(this.model=e.model)}#l(e){let t=new FormData(e);return this.link===`tcp`?`tcp:${String(t.get(`host`)).trim()}`:`serial:${String(t.get(`port`)).trim()}:${String(t.get(`baud`))}`}async#u(e){let t=e.target.closest(`form`);this.busy=!0,this.problem=null;try{this.found=await this.api.find(this.#l(t))}catch(e){this.problem=U(e)}this.busy=!1}async#d(e){e.preventDefault();let t=e.target,n=new FormData(t),r=String(n.get(`address`)).trim(),i=r===``?null:Q(r);if(r!==``&&i===null){this.problem=`The address is a number.`;return}let a={name:String(n.get(`name`)).trim(),model:String(n.get(`model`)),link:this.#l(t),...i===null?{}:{address:i}};await this.#f(()=>this.api.addReal(a),`Connected`)}async#f(e,t){this.busy=!0,this.problem=null;try{await e(),q(t),this.dispatchEvent(new Event(`done`))}catch(e){this.problem=U(e)}this.busy=!1}};customElements.define(`pt-add`,Pt);var Ft=2e3,It=400,Lt=4,Rt=class extends L{static properties={api:{attribute:!1},control:{attribute:!1},devices:{state:!0},problem:{state:!0},adding:{state:!0},filter:{state:!0}};#e=new Map;#t=new Set;#n=0;#r=0;#i=new IntersectionObserver(e=>{for(let t of e){let e=t.target.dataset.name;t.isIntersecting?this.#t.add(e):this.#t.delete(e)}});static styles=[G,u`
      .top {
        margin: 8px 0 14px;
      }
      h1 {
        font-size: 18px;
      }
      .cards {
        display: grid;
        grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr));
        gap: 12px;
        padding: 0;
        margin: 0;
        list-style: none;
      }
      .card {
        display: flex;
        flex-direction: column;
        gap: 8px;
      }
      .card.lost {
        border-color: var(--error);
      }
      .head {
        display: flex;
        align-items: baseline;
        gap: 8px;
      }
      .head a {
        overflow: hidden;
        font-size: 16px;
        font-weight: 650;
        text-decoration: none;
        text-overflow: ellipsis;
      }
      .where {
        overflow: hidden;
        color: var(--muted);
        font-size: 12px;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      td,
      th {
        padding: 2px 6px;
      }
      td:first-child,
      th:first-child {
        padding-left: 0;
        width: 2.2em;
      }
      tr:last-child td {
        border-bottom: 0;
      }
      .foot {
        margin-top: auto;
      }
      input[type="search"] {
        width: 200px;
      }
    `];constructor(){super(),this.devices=null,this.problem=null,this.adding=null,this.filter=``}connectedCallback(){super.connectedCallback(),this.#a(),this.#o()}disconnectedCallback(){super.disconnectedCallback(),clearTimeout(this.#n),clearTimeout(this.#r),this.#i.disconnect()}async#a(){clearTimeout(this.#n);try{this.devices=await this.api.devices(),this.problem=null}catch(e){this.problem=U(e)}this.isConnected&&(this.#n=window.setTimeout(()=>void this.#a(),Ft))}async#o(){if(!document.hidden){let e=(this.devices??[]).map(({name:e})=>e).filter(e=>this.#t.has(e));await Promise.all(Array.from({length:Lt},async()=>{for(let t=e.pop();t!==void 0;t=e.pop())this.#e.set(t,await this.api.status(t).catch(()=>null))})),this.requestUpdate()}this.isConnected&&(this.#r=window.setTimeout(()=>void this.#o(),It))}updated(){this.#i.disconnect();for(let e of this.renderRoot.querySelectorAll(`.card`))this.#i.observe(e)}render(){let e=this.filter.toLowerCase(),t=(this.devices??[]).filter(t=>`${t.name} ${t.title} ${t.model} ${t.endpoints.join(` `)}`.toLowerCase().includes(e));return O`
      <div class="row top">
        <h1>Controllers</h1>
        <span class="muted">${this.devices?this.devices.length:``}</span>
        <div class="grow"></div>
        ${(this.devices?.length??0)>6?O`<input type="search" aria-label="Find a controller" placeholder="Find…"
              @input=${e=>this.filter=e.target.value} />`:A}
        <div class="row">
          <button @click=${()=>this.adding=`bench`}>Add virtual…</button>
          <button @click=${()=>this.adding=`real`}>Connect real…</button>
        </div>
      </div>
      ${this.problem?O`<p class="panel error-text" role="alert">${this.problem}</p>`:A}
      <ul class="cards">
        ${K(t,({name:e})=>e,e=>this.#c(e))}
      </ul>
      ${this.devices?.length===0?O`<p class="muted">There is none yet.</p>`:A}
      <pt-add .api=${this.api} .kind=${this.adding} @done=${this.#s} @close=${()=>this.adding=null}></pt-add>
    `}#s(){this.adding=null,this.#a()}#c(e){let t=this.#e.get(e.name)??null,n=e.link.state===`lost`?e.link.reason:null,r=t?.programs.filter(({state:e})=>e===`running`).length??0;return O`
      <li class="card panel ${n?`lost`:``}" data-name=${e.name}>
        <div class="head">
          <a href=${W(e.name)}>${e.name}</a>
          <span class="muted">${e.title}</span>
          <span class="grow"></span>
          <span class="badge">${e.kind}</span>
        </div>
        <div class="where" title=${e.endpoints.join(`
`)}>${e.endpoints.join(` · `)||`no endpoint`}</div>
        ${e.link.state===`connecting`?O`<p class="muted">Connecting…</p>`:A}
        ${n?O`<p class="error-text">Lost: ${n}</p>`:A}
        ${t?this.#l(e,t):A}
        ${t?.alarms.map(e=>O`<div class="error-text">⚠ ${e}</div>`)}
        <div class="row foot">
          <button class="small" @click=${()=>J(()=>this.api.stop(e.name),`Stop sent to ${e.name}`)}>
            ■ Stop
          </button>
          ${r>0?O`<span class="badge busy">${r===1?`program runs`:`${r} programs run`}</span>`:A}
          <span class="grow"></span>
          ${e.removable?O`<button class="small plain" aria-label="Remove ${e.name}" @click=${()=>this.#u(e)}>
                Remove
              </button>`:A}
        </div>
      </li>
    `}#l(e,t){return O`
      <table aria-label="Axes of ${e.name}">
        <thead>
          <tr><th>Axis</th><th class="number">Position</th><th class="number">Speed</th><th>State</th></tr>
        </thead>
        <tbody>
          ${e.axis_names.flatMap(e=>t.axes[e]?[[e,t.axes[e]]]:[]).map(([e,t])=>O`
              <tr>
                <td><strong>${e}</strong></td>
                <td class="number">${Z(t.position)}</td>
                <td class="number">${Z(t.speed)}</td>
                <td><span class="badge ${Mt(t)}">${t.error??t.state}</span></td>
              </tr>
            `)}
        </tbody>
      </table>
    `}async#u(e){await ot({heading:`Remove ${e.name}?`,text:e.kind===`virtual`?`The virtual controller and its endpoints go away, with what its memory holds.`:`The page forgets the controller; nothing is sent to it.`,yes:`Remove`,danger:!0})&&await J(()=>this.api.remove(e.name),`${e.name} removed`)&&await this.#a()}};customElements.define(`pt-overview`,Rt);var $=`token`,zt=[[`system`,`◐ system`],[`dark`,`☾ dark`],[`light`,`☀ light`]];function Bt(){let e=new URL(location.href),t=e.searchParams.get($);return t!==null&&(sessionStorage.setItem($,t),e.searchParams.delete($),history.replaceState(null,``,e)),sessionStorage.getItem($)??``}var Vt=class extends L{static properties={route:{state:!0},refused:{state:!0}};#e=new Je(Bt());#t=null;static styles=[G,u`
      header {
        position: sticky;
        top: 0;
        z-index: 10;
        display: flex;
        align-items: center;
        gap: 10px;
        padding: 6px 14px;
        background: var(--panel);
        border-bottom: 1px solid var(--line);
      }
      .brand {
        display: flex;
        align-items: center;
        gap: 8px;
        color: var(--text);
        font-weight: 700;
        text-decoration: none;
      }
      .brand img {
        display: block;
        width: 22px;
        height: 22px;
      }
      .crumb {
        font-size: 14px;
        font-weight: 400;
        overflow: hidden;
        color: var(--muted);
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .crumb strong {
        color: var(--text);
        font-weight: 600;
      }
      .theme {
        width: auto;
        min-height: 30px;
      }
      .content {
        max-width: 1560px;
        margin: 0 auto;
        padding: 8px 14px 24px;
      }
      .lease {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 8px 12px;
        padding: 6px 14px;
        background: var(--warn-bg);
        color: var(--warn);
        font-weight: 550;
      }
      form {
        max-width: 460px;
        margin: 12vh auto 0;
      }
      @media (max-width: 700px) {
        .brand span,
        .lease-mine {
          display: none;
        }
        header {
          padding: 6px 10px;
        }
        header button.stop {
          position: fixed;
          z-index: 20;
          right: 10px;
          bottom: 10px;
          left: 10px;
          min-height: 48px;
          font-size: 16px;
          box-shadow: 0 2px 14px rgb(0 0 0 / 0.35);
        }
        .content {
          padding: 4px 10px 76px;
        }
      }
    `];constructor(){super(),this.route=Qe(location.hash),this.refused=!this.#e.hasToken,this.#n(),window.addEventListener(`hashchange`,()=>{this.route=Qe(location.hash)}),window.addEventListener(it,()=>void this.#r()),window.addEventListener(`keydown`,e=>{e.key===`Escape`&&!e.repeat&&this.#r()},{capture:!0})}#n(){this.refused||(this.#e.addEventListener(`unauthorized`,()=>{this.refused=!0}),this.#t=new Xe(this.#e),this.#t.addEventListener(`change`,()=>this.requestUpdate()))}async#r(){if(this.refused)return;let{device:e}=this.route;await J(async()=>{let t=e===null?(await this.#e.devices()).map(({name:e})=>e):[e],n=(await Promise.allSettled(t.map(e=>this.#e.stop(e)))).find(e=>e.status===`rejected`);if(n)throw n.reason;q(e===null?`Stop sent to every controller`:`Stop sent to ${e}`)})}updated(){document.title=this.route.device?`${this.route.device} – Pulsetrain`:`Pulsetrain`}render(){let{device:e,tab:n}=this.route;return O`
      <header>
        <a class="brand" href=${W(null)} aria-label="Pulsetrain, all controllers">
          <img src="/icon.svg" alt="" /><span>Pulsetrain</span>
        </a>
        ${e?O`<h1 class="crumb">/ <strong>${e}</strong></h1>`:A}
        <div class="grow"></div>
        ${this.#a()}
        <select class="theme" aria-label="Colours" @change=${this.#i}>
          ${zt.map(([e,n])=>O`<option value=${e} ?selected=${t()===e}>${n}</option>`)}
        </select>
        <button class="stop" title="Escape" aria-keyshortcuts="Escape" @click=${()=>this.#r()}>
          ■ ${e?`STOP`:`STOP ALL`}
        </button>
      </header>
      ${this.#o()}
      <div class="content">
        ${this.refused?this.#s():e?We(e,O`
              <pt-controller .api=${this.#e} .control=${this.#t} .name=${e} .tab=${n}></pt-controller>
            `):O`<pt-overview .api=${this.#e} .control=${this.#t}></pt-overview>`}
      </div>
      <pt-toasts></pt-toasts>
    `}#i(e){n(e.target.value)}#a(){return this.#t?.mine?O`
      <span class="lease-mine badge ok">you have control</span>
      <button class="lease-mine small plain" @click=${()=>J(()=>this.#t.release())}>Give back</button>
    `:A}#o(){let e=this.#t;return!e||e.mine||e.holder===null?A:O`
      <div class="lease" role="status">
        <span>${e.holder} has control. You can look, and stop.</span>
        <button class="small" @click=${()=>J(()=>e.take())}>Take over</button>
      </div>
    `}#s(){return O`
      <form class="panel stack" @submit=${this.#c}>
        <h2>Who are you?</h2>
        <p>
          Open the address that <code>pulsetrain serve</code> prints when it starts, or enter the token at its end.
        </p>
        <label>Token <input name="token" type="text" autocomplete="off" spellcheck="false" required /></label>
        <div class="row"><button class="primary">Open</button></div>
      </form>
    `}#c(e){e.preventDefault();let t=new FormData(e.target).get(`token`);sessionStorage.setItem($,String(t).trim()),location.reload()}};customElements.define(`pt-app`,Vt),r();export{Se as C,O as S,l as T,R as _,jt as a,L as b,ct as c,q as d,K as f,Re as g,U as h,Ot as i,ot as l,W as m,At as n,Q as o,G as p,Z as r,kt as s,Mt as t,J as u,z as v,u as w,A as x,Fe as y};